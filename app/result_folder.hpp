// The result folder as a whole: made, cleared of an older run, its copy of the scene. The rooms write their own files.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/scene/scene.hpp"

namespace weaveform {

// results/NAME, NAME being the scene file's name without its ending.
[[nodiscard]] std::filesystem::path default_result_folder(const std::filesystem::path& scene_file);

// Makes the folder and clears it of an older run's files. Files that are not Weaveform's are left alone; a scene.toml
// that Weaveform did not write is an InputError, because the run's own copy would overwrite somebody's work. Throws
// FileError when the folder cannot be made.
void prepare_folder(const std::filesystem::path& directory);

// Removes what solve and post write (frames, result.pvd, history.csv, ...), so that no old frame mixes with new
// results.
void remove_results(const std::filesystem::path& directory);

// DIR/scene.toml: every key with its value, under a line that names the program; written whole or not at all.
void write_scene_copy(const Scene& scene, const std::filesystem::path& directory);

// Throws FileError unless DIR/NAME is there, saying which command makes it.
void require_file(const std::filesystem::path& directory, const std::string& name, const std::string& made_by);

}  // namespace weaveform
