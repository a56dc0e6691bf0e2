// Where a result folder of a stack has what is one ply's own: plies/NAME.
#pragma once

#include <filesystem>
#include <string>

#include "core/files/owned_files.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char* plies = "plies";
}

// Made where it is not there.
[[nodiscard]] inline std::filesystem::path ply_folder(const std::filesystem::path& directory, const std::string& ply) {
  const std::filesystem::path own = directory / file_name::plies / ply;
  std::filesystem::create_directories(own);
  return own;
}

// Files that lie there once for each ply, as names below the result folder.
[[nodiscard]] inline FileNames in_ply_folders(FileNames names) {
  return below(std::string(file_name::plies) + "/*", std::move(names));
}

}  // namespace weaveform
