// The three theoretical zones of a bias extension, found on the mesh, and the shear angle over each.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "post/measure/bias_extension.hpp"

namespace weaveform {

// A: both yarns of a point run from free edge to free edge; B: one of them ends in a grip; C: both do. A cell cut by a
// line between zones is `straddling` and counts for none, as its angle is a mixture.
enum class Zone { a, b, c, straddling };

// (across, along) are a point's coordinates in the flat specimen, mm, from its centre.
[[nodiscard]] Zone zone_of_point(const BiasSpecimen& specimen, double across, double along);

// Per cell, from the mesh's initial (flat) positions.
[[nodiscard]] std::vector<Zone> zones_of_cells(const Mesh& mesh, const BlankSpec& blank, const BiasSpecimen& specimen);

struct ZoneAngle {
  int cells = 0;
  double area = 0.0;  // mm^2; flat
  double mean = 0.0;  // rad; weighted with the flat area; not a number when the zone has no cell
  double sd = 0.0;    // rad
};

// Over zones A, B, C in this order.
[[nodiscard]] std::array<ZoneAngle, 3> angles_by_zone(const MeshCells& cells, const std::vector<Zone>& zone,
                                                      const std::vector<double>& shear_angle);

}  // namespace weaveform
