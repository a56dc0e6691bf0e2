// checkpoint.bin: everything an interrupted analysis needs to go on with the same bits.
#pragma once

#include <filesystem>

#include "solver/lattice/state.hpp"
#include "solver/motion/balance.hpp"
#include "solver/motion/energy.hpp"
#include "solver/motion/reach.hpp"
#include "solver/motion/recorder.hpp"

namespace weaveform {

struct Checkpoint {
  State state;                              // position, velocity, time, step (forces are computed again)
  double step_before = 0.0;                 // s; length of the step just taken
  double step = 0.0;                        // s; length of the next one
  double smallest_step = 0.0;               // s
  double viscous_time = 0.0;                // s; beta of yarn.hpp
  Reach::Memory reach;                      // what the step allows yarns to reach
  double power_before = 0.0;                // mJ/s; damping power at the last step
  std::vector<double> force_before;         // N; grips' forces at the last step
  std::vector<double> displacement_before;  // mm; grips' displacement at the last step
  double wall_s = 0.0;
  int next_row = 0, next_frame = 0;
  EnergyBalance balance;
  double grip_work = 0.0, damping_work = 0.0;  // mJ
  double worst_error = 0.0, worst_ratio = 0.0;
  int folded = 0;
  InternalEnergy::Path path;
  std::vector<double> cell_history;              // of formulations that have one
  std::vector<std::vector<double>> term_memory;  // of each force term
  History history;
  Recorder::Window window;
};

// `identity` ties the file to its mesh and scene; reading a checkpoint with another identity throws InputError.
void write_checkpoint(const Checkpoint& checkpoint, const std::string& identity, const std::filesystem::path& file);
[[nodiscard]] Checkpoint read_checkpoint(const std::string& identity, const std::filesystem::path& file);

}  // namespace weaveform
