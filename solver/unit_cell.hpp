// The unit cell (the paper's Fig. 6): one cell of fabric with the halves of its four yarns, sheared as a trellis by the
// solver's own inner loop, its normalised shear force taken from the nodal forces. The first test of any element.
//
// Trellis motion: the yarns keep their length and turn towards each other by half the shear angle gamma each. Eq. 13
// with Eq. 12 gives the power a frame puts into fabric of flat area A = L_f^2: F d(delta)/dt = F_sh A cos(gamma)
// d(gamma)/dt. With v = dx/d(gamma) the nodes' velocities in that motion and f their internal forces,
//   F_sh = -sum(f . v) / (A cos gamma)                                                   (N/mm)
#pragma once

#include <array>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct UnitCellMotion {
  double angle = 0.0;     // rad; shear angle at the end, |angle| < pi/2
  int increments = 1;     // equal increments of the angle from the flat cell on
  double rotation = 0.0;  // rad; rigid rotation in the plane at the end, superposed in proportion to the angle
};

struct UnitCellPoint {
  double angle = 0.0;  // rad
  double force = 0.0;  // N/mm; normalised shear force, of the angle's sign where the fabric resists
};

// `sides`: mm, along the warp and along the weft. One point after each increment. Throws InputError when a law of the
// card does not fit the inner loop (solver/lattice/forces.hpp).
[[nodiscard]] std::vector<UnitCellPoint> shear_unit_cell(const Card& card, const ModelSpec& model,
                                                         const std::array<double, 2>& sides,
                                                         const UnitCellMotion& motion);

}  // namespace weaveform
