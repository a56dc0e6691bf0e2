#include "app/command_tree.hpp"

#include <sstream>

namespace weaveform {
namespace {

// CLI11 writes the only values of an option into the name of its type, as "TEXT:{a,b}".
std::vector<std::string> choices_in(const std::string& type) {
  const std::size_t begin = type.find(":{"), end = type.rfind('}');
  if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
  std::vector<std::string> choices;
  std::istringstream list(type.substr(begin + 2, end - begin - 2));
  for (std::string one; std::getline(list, one, ',');) choices.push_back(one);
  return choices;
}

CommandOption option_of(const CLI::Option& option) {
  CommandOption one;
  one.is_positional = !option.nonpositional();
  if (one.is_positional) {
    one.names = {option.get_name()};
  } else {
    for (const std::string& name : option.get_snames()) one.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) one.names.push_back("--" + name);
  }
  const bool takes_value = option.get_items_expected_max() > 0;
  if (takes_value && !one.is_positional) {
    const std::string type = option.get_type_name();
    one.choices = choices_in(type);
    one.value = type.substr(0, type.find(':'));
    if (one.value == "TEXT" || one.value.empty()) one.value = "VALUE";
  }
  one.description = option.get_description();
  one.is_required = option.get_required();
  one.is_repeatable = takes_value && option.get_items_expected_max() > 1;
  return one;
}

void append(const CLI::App& app, const std::string& path, std::vector<Command>& tree) {
  Command command{.path = path, .description = app.get_description(), .commands = {}, .options = {}};
  for (const CLI::Option* option : app.get_options()) command.options.push_back(option_of(*option));
  const auto below = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* one : below) command.commands.push_back(one->get_name());
  tree.push_back(std::move(command));
  for (const CLI::App* one : below) append(*one, path.empty() ? one->get_name() : path + " " + one->get_name(), tree);
}

}  // namespace

std::vector<Command> command_tree(const CLI::App& program) {
  std::vector<Command> tree;
  append(program, "", tree);
  return tree;
}

}  // namespace weaveform
