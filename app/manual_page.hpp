// The manual page weaveform(1), and the completion of command lines for bash: both from the program's own commands.
#pragma once

#include <string>
#include <vector>

#include "app/command_tree.hpp"

namespace weaveform {

// In man's own language (groff_man(7)).
[[nodiscard]] std::string manual_page(const std::vector<Command>& tree);

// To be sourced by bash 4 or later, or put where bash-completion looks: /usr/share/bash-completion/completions/weaveform.
// Completes commands, options, the values of options that have a list, folders where a folder is due, and else files.
[[nodiscard]] std::string bash_completion(const std::vector<Command>& tree);

}  // namespace weaveform
