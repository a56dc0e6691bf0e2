// Files of a folder that are ours by their names. Each room says what it writes; whoever clears a folder, or refuses to
// write over a stranger's, asks those lists.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace weaveform {

// Names below a folder: "history.csv", "frames/frame_####.vtu" ('#': one digit or more, so that
// '####' are four or more), "work_precision_*.svg" ('*': any
// characters but '/'; not a '.' at the beginning of a name).
using FileNames = std::vector<std::string>;

[[nodiscard]] bool is_one_of(std::string_view name, const FileNames& names);

// What is there under one of the names, links too, in rising order; folders are looked into, but not where they are
// links, and are not named themselves.
[[nodiscard]] std::vector<std::filesystem::path> present_files(const std::filesystem::path& directory,
                                                               const FileNames& names);

// Removes them, and the folders below `directory` that are empty then. Throws std::filesystem::filesystem_error.
void remove_files(const std::filesystem::path& directory, const FileNames& names);

// The names as they are below `folder`.
[[nodiscard]] FileNames below(const std::string& folder, FileNames names);

// All of several lists.
[[nodiscard]] FileNames joined(std::initializer_list<FileNames> lists);

}  // namespace weaveform
