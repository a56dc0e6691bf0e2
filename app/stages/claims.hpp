// What a result folder owns, as said by those who write it, and what a command may therefore write to it, clear away or
// must leave alone. docs/results.md has the table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

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
[[nodiscard]] OutputClaim report_claim(const std::filesystem::path& directory, const Scene& scene);

// Scene file, material card, outline and tools, as far as they are files.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Scene& scene);

// Removes all that older commands left of another scene, in a folder that is claimed: mesh, results, comparisons, the
// tools that came with an imported mesh. Files that `next`, the scene to come, names are left alone, as are all that no
// command wrote.
void clear_folder(const std::filesystem::path& directory, const Scene& next);

// Removes what comes of a solve (frames, history.csv, post's answers, comparisons, ...), so that nothing old stands
// beside new results.
void remove_results(const std::filesystem::path& directory);

}  // namespace weaveform
