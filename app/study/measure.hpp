// A number of a finished case, by name:
//   grips.top.force_N        a number (or true/false as 1/0) of summary.json by its path; list elements by 0-based
//   index last(top.force_N)        the last value of a column of history.csv; also max(...) and min(...)
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"

namespace weaveform::study {

// The measure's value in the result folder. Throws InputError when there is no such number (with the nearest valid
// name), FileError when its file cannot be read. Not a number where the file says null.
[[nodiscard]] double measure(const std::filesystem::path& directory, const std::string& name);

// What the run says against itself: `warnings` of summary.json. Throws InputError (a damaged or older file), FileError.
[[nodiscard]] std::vector<std::string> warnings_of(const std::filesystem::path& directory);

// The scene's own: the greatest shear angle, and the last force of each grip, frame and tool.
[[nodiscard]] std::vector<std::string> default_measures(const Scene& scene);

// h = sqrt(warp spacing * weft spacing) of DIR/mesh.vtu, mm: the size of its cells as it was built (fitted to the
// grips, it is not that of blank.coarsening). Throws FileError.
[[nodiscard]] double mesh_size(const std::filesystem::path& directory);

}  // namespace weaveform::study
