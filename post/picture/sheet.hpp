// What of a folder is drawn, and what a file of it holds for that: the frames of a run, or the net that a drape left.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform {

// Frames with their times; of a drape its one file, at 0. Throws as ResultFolder::frames does.
[[nodiscard]] std::vector<FrameFile> frames_to_draw(ResultFolder& folder);

// The scene with its tools, whether or not the folder has a mesh (a drape has none of its own). Throws as
// ResultFolder::model does.
[[nodiscard]] Resolved model_to_draw(ResultFolder& folder);

// How far each tool has moved since the start, mm; not at all where nothing was run.
[[nodiscard]] std::vector<Vec3> tools_moved(ResultFolder& folder, const Resolved& model, double time);

// Polygons and lines of one frame, with one value for each polygon.
struct Sheet {
  std::vector<Vec3> position;  // mm
  std::vector<std::vector<int>> polygon;
  std::vector<std::array<int, 2>> yarn;
  std::vector<double> value;
};

// Throws FileError, and InputError for a file without that array on cells.
[[nodiscard]] Sheet read_sheet(const std::filesystem::path& file, const std::string& field);

}  // namespace weaveform
