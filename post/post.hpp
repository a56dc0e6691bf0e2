// Results -> answers: contours, zones, the table a user reads, summary.json.
#pragma once

#include <filesystem>
#include <string>

namespace weaveform {

// Reads the result folder (scene.toml, mesh.vtu, result.pvd, frames, history.csv, solve.json) and writes contours.vtp
// and summary.json into it, for a scene with tools also the files of forming/forming.hpp. Returns the table printed at
// the end of a run. Of a run that is not finished, everything is of its last frame, `finished` is false in summary.json
// and a warning says to what time it came. Throws FileError or InputError (which file is missing).
std::string post_process(const std::filesystem::path& directory);

}  // namespace weaveform
