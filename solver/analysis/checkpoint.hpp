// checkpoint.bin: everything that a stopped or killed analysis needs to go on with the same bits.
//
//   "weaveform checkpoint 4\n"   magic and format
//   u64 size of the file, u64 check sum (XXH3) of all that follows
//   identity of the run (identity.hpp)
//   the members of Checkpoint in the order of checkpoint.cpp; each list with its length before it
// Integers and doubles are the machine's own. The file is written whole, on disk before the one before it goes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "solver/analysis/balance.hpp"
#include "solver/analysis/identity.hpp"
#include "solver/analysis/recorder.hpp"
#include "solver/ply/energy.hpp"
#include "solver/ply/reach.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

struct Checkpoint {
  State state;                              // position, velocity, force, time, step
  double step_before = 0.0;                 // s; length of the step just taken
  double step = 0.0;                        // s; length of the next one
  double smallest_step = 0.0;               // s
  std::string step_set_by;                  // the part that set the smallest
  double viscous_time = 0.0;                // s; beta of yarn.hpp
  Reach::Memory reach;                      // what the step allows yarns to reach
  double power_before = 0.0;                // mJ/s; damping power at the last step
  std::vector<double> force_before;         // N; grips' forces at the last step
  std::vector<double> displacement_before;  // mm; grips' displacement at the last step
  double wall_s = 0.0;
  std::int64_t next_row = 0, next_frame = 0;
  std::vector<double> frame_times;  // s; of the frames written
  EnergyBalance balance;
  double grip_work = 0.0, damping_work = 0.0;  // mJ
  double worst_error = 0.0, worst_ratio = 0.0;
  std::int64_t folded = 0;
  InternalEnergy::Path path;
  std::vector<double> fabric;                    // FabricForces::memory
  std::vector<std::vector<double>> term_memory;  // of each force term
  std::vector<std::vector<double>> row;          // of the history
  Recorder::Window window;
};

// What this mesh and scene need: every list of a checkpoint is compared with it before room is made for the list.
struct CheckpointSizes {
  std::size_t nodes = 0;  // packed
  std::size_t grips = 0;
  std::size_t columns = 0;  // of the history
  std::size_t rows = 0;     // of it, at most
  std::size_t frames = 0;   // at most
  std::size_t impulses = 0;
  std::size_t path_cells = 0;  // cells of the path integral, where there is one (it may not have begun)
  std::size_t fabric = 0;
  std::vector<std::size_t> term;
  double duration = 0.0;  // s
};

enum class CheckSum { compared, ignored };  // ignored: for those who look for what a forged file could do

// The file's bytes.
[[nodiscard]] std::string checkpoint_bytes(const Checkpoint& checkpoint, const Identity& identity);
// `name` stands for the file in messages. Throws FileError when the bytes are no checkpoint of this format, are damaged
// or do not fit `expected`; InputError when they are another run's, with what differs.
[[nodiscard]] Checkpoint read_checkpoint(std::string_view bytes, const Identity& identity,
                                         const CheckpointSizes& expected, const std::string& name,
                                         CheckSum check = CheckSum::compared);

// Whether every number of the state and of the sums over time is one.
[[nodiscard]] bool is_finite(const Checkpoint& checkpoint);

// "NAME: damaged checkpoint (WHY); ...".
[[noreturn]] void throw_damaged_checkpoint(const std::string& name, const std::string& why);

}  // namespace weaveform
