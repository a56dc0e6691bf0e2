// Results -> answers: contours, zones, the table a user reads, summary.json.
#pragma once

#include <filesystem>
#include <string>

namespace weaveform {

// Reads the result folder (scene.toml, mesh.vtu, result.pvd, frames, history.csv, solve.json) and writes contours.vtp
// and summary.json into it, for a scene with tools also the files of forming/forming.hpp. Returns the table printed at
// the end of a run. Throws FileError or InputError (which file is missing).
std::string post_process(const std::filesystem::path& directory);

}  // namespace weaveform
