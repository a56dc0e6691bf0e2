// The borders, one file each; a border adds its line when the run is beyond it. Each is pinned on both sides by a test
// of the same name (tests/verify/stability_*_test.cpp).
#pragma once

#include <string>
#include <vector>

#include "post/trust/warnings.hpp"

namespace weaveform {

using Warnings = std::vector<std::string>;

void warn_of_bias_extension_mesh(const FinishedRun& run, Warnings& warnings);
void warn_of_coarse_on_tools(const FinishedRun& run, Warnings& warnings);
void warn_of_fast_loading(const FinishedRun& run, Warnings& warnings);
void warn_of_folds_of_the_mesh(const FinishedRun& run, Warnings& warnings);
void warn_of_missed_accuracy(const FinishedRun& run, Warnings& warnings);
void warn_of_unrest(const FinishedRun& run, Warnings& warnings);
void warn_of_unsteady_tools(const FinishedRun& run, Warnings& warnings);
void warn_of_compressed_yarns(const FinishedRun& run, Warnings& warnings);
void warn_of_energy_error(const FinishedRun& run, Warnings& warnings);
void warn_of_folded_cells(const FinishedRun& run, Warnings& warnings);
void warn_of_formulation(const FinishedRun& run, Warnings& warnings);
void warn_of_idle_scene(const FinishedRun& run, Warnings& warnings);
void warn_of_idle_tools(const FinishedRun& run, Warnings& warnings);
void warn_of_stretch_beyond_card(const FinishedRun& run, Warnings& warnings);
void warn_of_shear_beyond_card(const FinishedRun& run, Warnings& warnings);

// What the borders above look at, for who asks whether they were kept to (assumptions.cpp).

// 1; of the area. Between tools a wrinkle, without them a zigzag from cell to cell; either stands off by a thickness at
// least.
[[nodiscard]] double folded_share(const Summary& summary);
// 1; of the loads, that inertia may be: analysis.inertia, or 0.02.
[[nodiscard]] double greatest_inertia(const Scene& scene);
// 1; chord over radius: what forces allow by the rules of thumb of docs/stability.md, or of a mesh that was taken for a
// wanted accuracy what that allows.
[[nodiscard]] double longest_chord(const Scene& scene);

}  // namespace weaveform
