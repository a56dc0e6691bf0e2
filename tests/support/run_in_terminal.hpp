// A command on a terminal of its own, as a person sees it.
#pragma once

#include <filesystem>
#include <string>

namespace weaveform::test {

// Everything that `command` (run by sh in `folder`, as run_command does) writes to a terminal of so many columns.
[[nodiscard]] std::string run_in_terminal(const std::string& command, const std::filesystem::path& folder, int columns);

}  // namespace weaveform::test
