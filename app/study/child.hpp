// A program run beside this one, its standard error in a file. It dies with this program, however that ends.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace weaveform::study {

// The program that runs now, to be run again as a child.
[[nodiscard]] std::filesystem::path this_program();

// Starts `arguments` (the first is the program), with standard output thrown away and standard error appended to `log`.
// Throws FileError when no process can be made.
[[nodiscard]] pid_t start_child(const std::vector<std::string>& arguments, const std::filesystem::path& log);

// The exit code as a shell tells it (128 + signal when killed), or nothing while the child runs.
[[nodiscard]] std::optional<int> poll_child(pid_t child);

}  // namespace weaveform::study
