// What an analysis will take before it is run: the table of `weaveform mesh --plan`.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace weaveform {

struct PlanRow {
  double factor = 1.0;                          // on the scene's coarsening
  std::string refused;                          // why there is no mesh at this coarsening; then nothing below counts
  int cells = 0, solved = 0;                    // of the whole, of the part that symmetry leaves
  double warp_length = 0.0, weft_length = 0.0;  // mm; of yarn
  double step = 0.0;                            // s; of the flat blank
  double steps = 0.0;                           // expected
  double seconds = 0.0;                         // expected, of the solve
  double megabytes = 0.0;                       // expected, of the whole process
  // Of a stack, each ply's own.
  struct Ply {
    std::string name;
    int cells = 0;
    double warp_length = 0.0, weft_length = 0.0;  // mm
  };
  std::vector<Ply> ply = {};
};

// Coarsening 8, 4, 2, 1 and a half of the scene's. Cells, lengths and the flat step are those of the real mesh; steps
// are duration over step, times what shear shortened the step by in a trial: the finest level of a few seconds' work, run
// to its end. Seconds are steps times what a few hundred steps took on the very mesh, on this machine, now. Throws
// InputError when no level can be meshed.
[[nodiscard]] std::vector<PlanRow> make_plan(const std::string& scene_file, const std::vector<std::string>& overrides,
                                             int threads);
[[nodiscard]] std::string plan_table(const std::vector<PlanRow>& rows);
// A list of the same rows: "coarsening_factor" and "no_mesh" (why), or "cells", "cells_solved", "warp_length_mm",
// "weft_length_mm", "flat_step_s", "steps", "wall_s", "memory_MB"; of a stack "plies" with "cells" and both lengths of each by name.
[[nodiscard]] nlohmann::ordered_json plan_json(const std::vector<PlanRow>& rows);

}  // namespace weaveform
