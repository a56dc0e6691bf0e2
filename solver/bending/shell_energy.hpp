// Stored energy of shell cells from their potentials, edge by edge and cell by cell, independent of the forces.
#pragma once

#include <vector>

#include "fabric/card/card.hpp"
#include "solver/bending/bending_energy.hpp"
#include "solver/bending/flexure.hpp"

namespace weaveform {

// One yarn element as the shell sees it.
struct ShellEdge {
  std::array<int, 2> node = {-1, -1};  // mesh
  int family = 0;
  double yarns = 0.0;
  double rest_length = 0.0;      // mm
  double shear_stiffness = 0.0;  // N mm; G w L
};

// All yarn elements but free ends that are tied in line with their yarn: the element before such an end bears its
// energy as well, as if there were more `yarns` (as the bends of bends.hpp do).
[[nodiscard]] std::vector<ShellEdge> find_shell_edges(const Mesh& mesh, const Card& card, double transverse_shear);

// mJ; `director` per mesh node.
[[nodiscard]] double shell_energy(const std::vector<ShellEdge>& edges, const std::vector<TwistCell>& cells,
                                  const Flexure& flexure, const std::array<double, 2>& spacing,
                                  const std::vector<Vec3>& position, const std::vector<Vec3>& director);

// mJ; of the alternating part of opposite edges' curvature and shear, over all full cells.
[[nodiscard]] double shell_hourglass_energy(const std::vector<TwistCell>& cells, const Flexure& flexure,
                                            const Card& card, const std::array<double, 2>& spacing,
                                            const std::vector<Vec3>& position, const std::vector<Vec3>& director);

}  // namespace weaveform
