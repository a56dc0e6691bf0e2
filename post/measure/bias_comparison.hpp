// A bias extension as simulated beside the ideal one: angle by zone at the end, angle and load over the travel. A stack of
// specimens that the same grips pull is one test: its ideal plies shear as each would alone, and their loads add up.
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
  double ideal_angle = 0.0;            // rad; with the sign the simulation has (of a stack the lowest ply's)
  double ideal_load = 0.0;             // N; inextensible yarns, of all plies
  std::array<double, 2> load = {};     // N; at the grips of BiasSpecimen::grip, positive when they pull
  std::vector<double> measured_angle;  // rad; mean of each measure of the scene
};

// Zones A, B, C of one ply at the end.
struct BiasZoneAngles {
  std::array<ZoneAngle, 3> simulated;
  std::array<double, 3> ideal = {};  // rad; with the sign the simulation has
};

struct BiasComparison {
  BiasSpecimen specimen;
  std::vector<BiasZoneAngles> zones;  // of each ply; of a scene without plies one
  std::vector<BiasRow> row;           // over the travel, the last one at the end
};

// A specimen as it was made, and its state at the end.
struct BiasPly {
  const Scene& scene;
  const Card& card;
  const Mesh& mesh;
  Fields end;
};

// `scene` is the whole one, which has the measures. Throws InputError when the history lacks a grip's column.
[[nodiscard]] BiasComparison compare_bias_extension(const BiasSpecimen& specimen, const Scene& scene,
                                                    const std::vector<BiasPly>& plies, const History& history);

}  // namespace weaveform
