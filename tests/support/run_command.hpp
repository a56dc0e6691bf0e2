// For tests of the program as its users meet it: run a shell command in a folder, look at what it said and left behind.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace weaveform::test {

struct CommandResult {
  int exit_code = -1;  // as a shell tells it: 128 + signal when killed
  std::string out;     // standard output
  std::string err;     // standard error
};

// Runs `command` by sh in `folder`; the word `weaveform` means the program under test.
[[nodiscard]] CommandResult run_command(const std::string& command, const std::filesystem::path& folder);

[[nodiscard]] std::string read_text(const std::filesystem::path& file);
void write_text(const std::string& text, const std::filesystem::path& file);

// A bias extension of a few cells, which runs in well under a second: PW, every fourth yarn.
[[nodiscard]] std::string tiny_scene();

// Whether the text, or what the command said on standard error, has `part` in it.
[[nodiscard]] inline bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}
[[nodiscard]] inline bool says(const CommandResult& result, const std::string& part) {
  return says(result.err, part);
}

}  // namespace weaveform::test
