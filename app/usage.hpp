// What is said of a command line that cannot be read.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace weaveform {

// One line: what is wrong, the nearest command or option where one is unknown, and where to read more.
[[nodiscard]] std::string usage_complaint(const CLI::App& program, const CLI::ParseError& error, int argc,
                                          const char* const* argv);

}  // namespace weaveform
