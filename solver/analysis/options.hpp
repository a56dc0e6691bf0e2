// What an analysis is asked beside its scene, and what it gives.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/log/listener.hpp"
#include "core/vector/vector.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct SolveOptions {
  int threads = 0;                             // 0: chosen from the size
  bool resume = false;                         // go on from the checkpoint
  bool quiet = false;                          // tell `progress` nothing
  long most_steps = 0;                         // stop there, for a trial; 0: run to the end
  long stop_at_step = 0;                       // stop there as if interrupted, with a checkpoint; 0: never
  std::string program = {};                    // version line, kept in checkpoint and statistics
  std::string scene_name = {};                 // file that the run was given, kept in the statistics
  ProgressWatch progress = {};                 // told from the thread that called solve
  std::function<bool()> stop_requested = {};   // asked after every step; true: leave a checkpoint and throw Interrupted
  std::filesystem::path checkpoint_file = {};  // none: DIR/checkpoint.bin, or no checkpoint where DIR is empty
};

struct SolveResult {
  History history;
  SolveStatistics statistics;
  std::vector<Vec3> position;  // mm; final
};

}  // namespace weaveform
