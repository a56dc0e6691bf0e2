// The explicit analysis: mesh + scene -> result folder.
#pragma once

#include <filesystem>
#include <functional>

#include "mesher/material/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct SolveOptions {
  int threads = 0;      // 0: chosen from the size
  bool resume = false;  // go on from DIR/checkpoint.bin
  bool quiet = false;
  long most_steps = 0;  // stop there, for a trial; 0: run to the end
};

struct SolveResult {
  History history;
  SolveStatistics statistics;
  std::vector<Vec3> position;  // mm; final
};

// Runs the analysis and writes the result folder (frames, history.csv, solve.json); an empty `directory` writes
// nothing. Throws PhysicsError (unstable, tangled, balance), FileError, Interrupted (checkpoint left in the folder).
SolveResult solve(const Mesh& mesh, const Scene& scene, const Card& card, const std::filesystem::path& directory,
                  const SolveOptions& options = {});

}  // namespace weaveform
