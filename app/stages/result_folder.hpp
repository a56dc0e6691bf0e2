// The result folder as a whole: claimed, cleared of an older run, its copy of the scene. The rooms write their own
// files.
#pragma once

#include <filesystem>
#include <string>

#include "app/stages/output_folder.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// results/NAME, NAME being the scene file's name without its ending.
[[nodiscard]] std::filesystem::path default_result_folder(const std::filesystem::path& scene_file);

// Everything that a run of the scene may write to the folder, and every file that the scene names, itself included. The
// folder's own copy of the scene may be run into its folder as long as the scene stays what it is.
[[nodiscard]] OutputClaim result_claim(const std::filesystem::path& directory, const Scene& scene);
// For the stages that read scene and mesh, and then the results too, from the folder.
[[nodiscard]] OutputClaim later_claim(const std::filesystem::path& directory, const Scene& scene);
[[nodiscard]] OutputClaim post_claim(const std::filesystem::path& directory, const Scene& scene);

// Scene file, material card, outline and tools, as far as they are files.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Scene& scene);

// Removes mesh and results of an older run, in a folder that is claimed. Other files are left alone.
void clear_folder(const std::filesystem::path& directory);

// Removes what solve and post write (frames, result.pvd, history.csv, ...), so that no old frame mixes with new
// results.
void remove_results(const std::filesystem::path& directory);

// DIR/scene.toml: every key with its value, under lines that name the program and the scene's own file; written whole
// or not at all. `name` stands for that file where the scene comes by way of another.
void write_scene_copy(const Scene& scene, const std::filesystem::path& directory, const std::string& name = "");

// The file that the folder's scene was read from; "" where its copy does not say.
[[nodiscard]] std::string scene_name_of(const std::filesystem::path& directory);

// Throws FileError unless DIR/NAME is there, saying which command makes it.
void require_file(const std::filesystem::path& directory, const std::string& name, const std::string& made_by);

}  // namespace weaveform
