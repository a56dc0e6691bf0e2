// A bias extension as simulated beside the ideal one: angle by zone at the end, angle and load over the travel.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "post/measure/bias_extension.hpp"
#include "post/measure/zones.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct BiasRow {
  double travel = 0.0;                 // mm; of the grips apart
  double ideal_angle = 0.0;            // rad; with the sign the simulation has
  double ideal_load = 0.0;             // N; inextensible yarns
  std::array<double, 2> load = {};     // N; at the grips of BiasSpecimen::grip, positive when they pull
  std::vector<double> measured_angle;  // rad; mean of each measure of the scene
};

struct BiasComparison {
  BiasSpecimen specimen;
  std::array<ZoneAngle, 3> simulated;      // zones A, B, C at the end
  std::array<double, 3> ideal_angle = {};  // rad; of the same
  std::vector<BiasRow> row;                // over the travel, the last one at the end
};

// Throws InputError when the history lacks a grip's column.
[[nodiscard]] BiasComparison compare_bias_extension(const BiasSpecimen& specimen, const Scene& scene, const Card& card,
                                                    const Mesh& mesh, const Fields& end, const History& history);

}  // namespace weaveform
