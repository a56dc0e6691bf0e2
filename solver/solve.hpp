// The explicit analysis: mesh + scene -> result folder.
#pragma once

#include <filesystem>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/analysis/options.hpp"

namespace weaveform {

// Runs the analysis and writes the result folder (frames, history.csv, solve.json); an empty `directory` writes
// nothing. A checkpoint is left every scene.output.checkpoint_minutes, and stays when the run does not end well. Throws
// PhysicsError (unstable, tangled, balance), FileError (also a damaged checkpoint), InputError (a checkpoint of another
// run), Interrupted (by a signal; the checkpoint is in the folder).
SolveResult solve(const Mesh& mesh, const Scene& scene, const Card& card, const std::filesystem::path& directory,
                  const SolveOptions& options = {});

// Whether a checkpoint waits in the folder, and whether the folder holds a run that came to its end.
[[nodiscard]] bool has_checkpoint(const std::filesystem::path& directory);
[[nodiscard]] bool is_finished(const std::filesystem::path& directory);

}  // namespace weaveform
