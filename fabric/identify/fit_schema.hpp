// Every key a fit file may hold: one row each. Reader and reference follow these rows. Those of [yarn] are the card's.
#pragma once

#include <vector>

#include "core/keys/key_table.hpp"
#include "fabric/identify/fit_spec.hpp"

namespace weaveform::identify {

[[nodiscard]] const std::vector<Key<FitHead>>& fit_head_keys();
[[nodiscard]] const std::vector<Key<ShearFitSpec>>& shear_fit_keys();
[[nodiscard]] const std::vector<Key<SimulationSpec>>& simulation_keys();
[[nodiscard]] const std::vector<Key<TestSpec>>& tensile_keys();
[[nodiscard]] const std::vector<Key<TestSpec>>& shear_frame_keys();
[[nodiscard]] const std::vector<Key<TestSpec>>& bias_extension_keys();
[[nodiscard]] const std::vector<Key<BendingFitSpec>>& bending_fit_keys();
[[nodiscard]] const std::vector<Key<TestSpec>>& moment_curvature_keys();
[[nodiscard]] const std::vector<Key<TestSpec>>& cantilever_keys();
[[nodiscard]] const std::vector<Key<TestSpec>>& peirce_keys();

}  // namespace weaveform::identify
