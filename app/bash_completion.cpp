#include <fmt/format.h>

#include "app/manual_page.hpp"

namespace weaveform {
namespace {

// The words of the line so far that are commands, in $command; then what may follow each.
constexpr const char* beginning = R"(# bash completion of weaveform, made by `weaveform help --completion`

_weaveform() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]} command="" i commands="" options=""
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "${command:+$command }${COMP_WORDS[i]}" in
)";

constexpr const char* middle = R"(        command="${command:+$command }${COMP_WORDS[i]}" ;;
    esac
  done
  case "$command" in
)";

constexpr const char* ending = R"(  esac
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$current")
  elif [[ -n $commands ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$commands" -- "$current")
    ((${#COMPREPLY[@]})) || mapfile -t COMPREPLY < <(compgen -f -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  fi
}
complete -o filenames -F _weaveform weaveform
)";

// What follows an option that takes a value of its own kind: "command:-o|command:--output) ... return ;;"
std::string values_of(const Command& command, const CommandOption& option) {
  if (option.is_positional || (option.choices.empty() && option.value != "DIR")) return "";
  std::vector<std::string> labels;
  for (const std::string& name : option.names) labels.push_back(fmt::format("\"{}:{}\"", command.path, name));
  const std::string words = option.choices.empty() ? "-d" : fmt::format("-W \"{}\"", fmt::join(option.choices, " "));
  return fmt::format("    {})\n      mapfile -t COMPREPLY < <(compgen {} -- \"$current\")\n      return ;;\n",
                     fmt::join(labels, "|"), words);
}

std::string words_of(const Command& command, const std::vector<std::string>& all_commands) {
  std::vector<std::string> options;
  for (const CommandOption& option : command.options)
    if (!option.is_positional) options.insert(options.end(), option.names.begin(), option.names.end());
  const auto& follow = command.path == "help" ? all_commands : command.commands;
  return fmt::format("    \"{}\") commands=\"{}\" options=\"{}\" ;;\n", command.path, fmt::join(follow, " "),
                     fmt::join(options, " "));
}

}  // namespace

std::string bash_completion(const std::vector<Command>& tree) {
  std::vector<std::string> labels;
  std::string words, values;
  for (const Command& command : tree) {
    if (!command.path.empty()) labels.push_back(fmt::format("\"{}\"", command.path));
    words += words_of(command, tree.front().commands);
    for (const CommandOption& option : command.options) values += values_of(command, option);
  }
  std::string text = beginning;
  text += fmt::format("      {})\n", fmt::join(labels, "|"));
  text += middle;
  text += words;
  text += "  esac\n  case \"$command:$previous\" in\n";
  return text + values + ending;
}

}  // namespace weaveform
