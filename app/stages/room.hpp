// Whether there is room for what a scene asks: memory and disk before anything large is made, time before the solve.
//
// What is expected of memory and disk was measured once and tells megabytes from terabytes; so do hours far below the
// limit. Hours near it are measured by a few steps on this machine. 'weaveform mesh --plan' measures all of it.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

// Throws InputError, with the numbers and the likely cause, when mesh and solve would take more memory than there is
// (analysis.most_memory, or what the machine has available); with `yes` only when no machine could hold the mesh. Of a
// stack ply by ply, `besides` (bytes) what those before take; gives those with this one's.
double require_memory(const Scene& scene, const Card& card, const BlankOutline& outline, bool yes,
                      double besides = 0.0);

// The same for the frames and the history in `directory`.
void require_disk(const Scene& scene, const Mesh& mesh, const std::filesystem::path& directory, bool yes);

// What a run is expected to take, on one thread.
struct ExpectedRun {
  int cells = 0, cells_solved = 0;  // of the whole, of the part that symmetry leaves
  double steps = 0.0, step = 0.0;   // step in s
  double wall = 0.0;                // s; of the solve
  double memory = 0.0;              // bytes; of the whole process
};
[[nodiscard]] std::string describe(const ExpectedRun& expected);  // one line for the log

// The same for the hours of the solve (analysis.most_hours), from the step that the first look at the mesh gives.
ExpectedRun require_time(const Resolved& model, bool yes);

}  // namespace weaveform
