// Stored energy of bending from its potentials, bend by bend and cell by cell, independent of the forces that moved the
// fabric, so that the energy balance is a test of the run.
#pragma once

#include <vector>

#include "solver/bending/bends.hpp"
#include "solver/bending/flexure.hpp"

namespace weaveform {

// A full cell that resists twist (bend_kernels.hpp).
struct TwistCell {
  std::array<int, 4> node = {-1, -1, -1, -1};  // x00, x10, x11, x01
  double area = 0.0;                           // mm^2; with its share of cut cells beside it
};

// The full quads of the lattice. Cut cells at the outline do not twist; the nearest full cell stands for their area.
[[nodiscard]] std::vector<TwistCell> find_twist_cells(const Mesh& mesh);

// mJ; at mesh positions.
[[nodiscard]] double bending_energy(const std::vector<Bend>& bends, const Flexure& flexure,
                                    const std::vector<Vec3>& position);
[[nodiscard]] double twist_energy(const std::vector<TwistCell>& cells, double twist,
                                  const std::array<double, 2>& spacing, const std::vector<Vec3>& position);

// 1/mm; curvature of each bend's two yarns, in plane and out of plane: {warp in, warp out, weft in, weft out}. Out of
// plane it is signed: positive when the yarn turns towards the fabric's normal (warp x weft).
[[nodiscard]] std::vector<std::array<double, 4>> curvatures(const std::vector<Bend>& bends,
                                                            const std::vector<Vec3>& position);

}  // namespace weaveform
