// weaveform help [COMMAND]: what --help prints; the manual page and the shell's completion, for packages.
#include <fmt/format.h>

#include <memory>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/manual_page.hpp"
#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"

namespace weaveform {

namespace {

void print_help(const CLI::App& program, const std::vector<std::string>& path) {
  const CLI::App* command = &program;
  std::string name = program.get_name();
  for (const std::string& word : path) {
    std::vector<std::string> names;
    const CLI::App* next = nullptr;
    for (const CLI::App* one : command->get_subcommands([](const CLI::App*) { return true; })) {
      names.push_back(one->get_name());
      if (one->get_name() == word) next = one;
    }
    if (next == nullptr) throw InputError(fmt::format("unknown command '{}'{}", word, did_you_mean(word, names)));
    command = next;
    name += " " + word;
  }
  // help() would follow the words of this command line, which lead to 'help'
  print_answer(command->get_formatter()->make_help(command, name, CLI::AppFormatMode::Normal));
}

}  // namespace

void add_help_command(CLI::App& program) {
  auto* command = program.add_subcommand("help", "Print what the program, or one of its commands, takes");
  const auto path = std::make_shared<std::vector<std::string>>();
  command->add_option("COMMAND", *path, "A command, e.g. run, or post compare");
  const auto page = std::make_shared<bool>(false);
  command->add_flag("--man", *page, "Print the manual page instead, for 'man -l -'");
  const auto shell = std::make_shared<std::string>();
  command->add_option("--completion", *shell, "Print the completion of command lines instead, for this shell to source")
      ->type_name("SHELL")
      ->check(CLI::IsMember({"bash"}));
  command->callback([&program, path, page, shell] {
    if (*page) return print_answer(manual_page(command_tree(program)));
    if (!shell->empty()) return print_answer(bash_completion(command_tree(program)));
    print_help(program, *path);
  });
}

}  // namespace weaveform
