// The borders, one file each; a border adds its line when the run is beyond it. Each is pinned on both sides by a test
// of the same name (tests/verify/stability_*_test.cpp).
#pragma once

#include <string>
#include <vector>

#include "post/trust/warnings.hpp"

namespace weaveform {

using Warnings = std::vector<std::string>;

void warn_of_coarse_on_tools(const FinishedRun& run, Warnings& warnings);
void warn_of_fast_loading(const FinishedRun& run, Warnings& warnings);
void warn_of_folds_of_the_mesh(const FinishedRun& run, Warnings& warnings);
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

}  // namespace weaveform
