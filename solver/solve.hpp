// The explicit analysis: mesh + scene -> result folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "mesher/material/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct SolveOptions {
  int threads = 0;      // 0: chosen from the size
  bool resume = false;  // go on from the checkpoint
  bool quiet = false;
  long most_steps = 0;                         // stop there, for a trial; 0: run to the end
  long stop_at_step = 0;                       // stop there as if interrupted, with a checkpoint; 0: never
  std::string program = {};                    // version line, kept in checkpoint and statistics
  std::string scene_name = {};                 // file that the run was given, kept in the statistics
  std::filesystem::path checkpoint_file = {};  // none: DIR/checkpoint.bin, or no checkpoint where DIR is empty
};

struct SolveResult {
  History history;
  SolveStatistics statistics;
  std::vector<Vec3> position;  // mm; final
};

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
