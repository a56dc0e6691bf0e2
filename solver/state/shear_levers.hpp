// How far the nodes of a cell turn its shear: with g1, g2 its directions and c1_a, c2_a their coefficients of node a
// (mesh.hpp),
//   r_a = |c1_a|/|g1| + |c2_a|/|g2| ,   |ds/dx_a| <= cos(gamma) r_a ,   |d2s/dx_a dx_b| <= 3 r_a r_b ,
// which is what the bounds of the stable step are made of.
#pragma once

#include <array>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {

struct ShearLevers {
  std::array<double, LooseCells::width> of_node = {};  // 1/mm; r_a, as the cell's entries stand
  double sum = 0.0;                                    // 1/mm
  double sine = 0.0;                                   // 1; sin gamma, within 1e-9 of +-1
};
[[nodiscard]] ShearLevers shear_levers(const MeshCells& cells, int cell, const std::vector<Vec3>& position);

}  // namespace weaveform
