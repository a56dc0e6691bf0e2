// The report of a result folder: one HTML page with verdict, part, charts and scene.
#pragma once

#include <filesystem>
#include <string>

#include "core/files/owned_files.hpp"
#include "post/post.hpp"

namespace weaveform {

namespace file_name {
inline constexpr const char* report = "report.html";
}

[[nodiscard]] inline FileNames report_files() {
  return {file_name::report};
}

// The page of a solved folder, of a run that is not finished up to its last frame. Throws as ResultFolder does.
[[nodiscard]] std::string result_report(ResultFolder& folder, const Evaluation& evaluation);
// The same into a file, whole or not at all. Throws FileError.
void write_report_page(ResultFolder& folder, const Evaluation& evaluation, const std::filesystem::path& file);

}  // namespace weaveform
