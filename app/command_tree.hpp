// The program's commands and options as its parser has them, in order: what the manual page and the completion are made
// from, so that neither can name what is not there.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace weaveform {

struct CommandOption {
  std::vector<std::string> names;    // "-o", "--output"; of a positional its name alone, "SCENE"
  std::string value;                 // "DIR"; "" where it takes none
  std::vector<std::string> choices;  // the only values, where there are such
  std::string description;
  bool is_positional = false, is_required = false, is_repeatable = false;
};

struct Command {
  std::string path;  // "post compare"; "" of the program itself
  std::string description;
  std::vector<std::string> commands;  // words that may follow: "compare"
  std::vector<CommandOption> options;
};

// The program itself first, then every command, each before those below it.
[[nodiscard]] std::vector<Command> command_tree(const CLI::App& program);

}  // namespace weaveform
