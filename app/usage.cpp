#include "app/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "core/keys/nearest_name.hpp"

namespace weaveform {
namespace {

bool is_option(const std::string& word) {
  return word.size() > 1 && word.front() == '-';
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// The command, or command of a command, that the words were given to.
const CLI::App& command_reached(const CLI::App& program) {
  const CLI::App* command = &program;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().back();
  return *command;
}

// "weaveform post compare"
std::string full_name(const CLI::App& command) {
  return command.get_parent() == nullptr ? command.get_name()
                                         : full_name(*command.get_parent()) + " " + command.get_name();
}

// Judged by its letters: the dashes, which all options share, make none of them nearer.
std::string nearest_option(const std::string& wrong, const CLI::App& command) {
  const auto letters = [](const std::string& name) { return name.substr(name.find_first_not_of('-')); };
  if (wrong.find_first_not_of('-') == std::string::npos) return "";
  const std::vector<std::string> names = option_names(command);
  const auto distance = [&](const std::string& name) { return edit_distance(letters(wrong), letters(name)); };
  const auto nearest = std::min_element(
      names.begin(), names.end(), [&](const auto& one, const auto& other) { return distance(one) < distance(other); });
  if (nearest == names.end()) return "";
  if (distance(*nearest) <= std::max<std::size_t>(2, letters(wrong).size() / 2))
    return fmt::format("; did you mean '{}'?", *nearest);
  return fmt::format("; valid: {}", fmt::join(names, ", "));
}

std::string unknown_option(const CLI::App& command, const std::string& word) {
  const std::string name = word.substr(0, word.find('='));
  return fmt::format("unknown option '{}' of '{}'{}", name, full_name(command), nearest_option(name, command));
}

// A word too many; where it or an earlier one is nearly a command of this command, that was meant.
std::string unexpected_word(const CLI::App& command, const std::string& word) {
  constexpr std::size_t near = 2;
  for (const std::string& name : command_names(command))
    for (const CLI::Option* option : command.get_options())
      if (option->get_positional() && !option->empty() && edit_distance(option->results().front(), name) <= near)
        return fmt::format("unknown command '{} {}'; did you mean '{}'?", full_name(command), option->results().front(),
                           name);
  return fmt::format("'{}' is one word too many for '{}'", word, full_name(command));
}

std::string what_is_wrong(const CLI::App& program, const CLI::ParseError& error,
                          const std::vector<std::string>& words) {
  const CLI::App& command = command_reached(program);
  if (&command == &program) {
    const auto first = std::find_if_not(words.begin(), words.end(), is_option);
    if (first != words.end())
      return fmt::format("unknown command '{}'{}", *first, did_you_mean(*first, command_names(program)));
    return words.empty() ? "no command is given" : unknown_option(command, words.front());
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
  const std::vector<std::string> extras = program.remaining(true);
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option != extras.end()) return unknown_option(command, *option);
  return extras.empty() ? error.what() : unexpected_word(command, extras.front());
}

}  // namespace

std::string usage_complaint(const CLI::App& program, const CLI::ParseError& error, int argc, const char* const* argv) {
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const CLI::App& command = command_reached(program);
  return fmt::format("{}; '{}' tells more", what_is_wrong(program, error, words),
                     &command == &program ? "weaveform help" : full_name(command) + " --help");
}

}  // namespace weaveform
