// The explicit analysis: mesh + scene -> result folder.
#pragma once

#include <filesystem>

#include "mesher/resolve/resolved.hpp"
#include "solver/analysis/options.hpp"

namespace weaveform {

// Runs the analysis and writes the result folder (frames, history.csv, solve.json); an empty `directory` writes
// nothing. A checkpoint is left every scene.output.checkpoint_minutes, and stays when the run does not end well. Throws
// PhysicsError (unstable, tangled, balance), FileError (also a damaged checkpoint), InputError (a checkpoint of another
// run), Interrupted (as options.stop_requested asks; the checkpoint is in the folder).
SolveResult solve(const Resolved& model, const std::filesystem::path& directory, const SolveOptions& options = {});

// The same of what is made by hand: outline, tools and symmetry are found here (resolve_around, which says what else is
// thrown).
SolveResult solve(const Mesh& mesh, const Scene& scene, const Card& card, const std::filesystem::path& directory,
                  const SolveOptions& options = {});

// Whether a checkpoint waits in the folder, and whether the folder holds a run that came to its end.
[[nodiscard]] bool has_checkpoint(const std::filesystem::path& directory);
[[nodiscard]] bool is_finished(const std::filesystem::path& directory);

}  // namespace weaveform
