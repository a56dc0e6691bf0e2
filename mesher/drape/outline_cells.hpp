// Cells that the blank's outline cuts. Their own corners do not tell their angle: a free end lies in line with its
// yarn, so that such a cell would repeat its neighbour's, and the part's greatest angle, which is most often at a
// corner, would be missed. The net is therefore laid one cell beyond the outline, and a cut cell has the net's angle at
// the centre of its cut shape, bilinear between the centres of the net's whole cells. On a sphere that is g(uv/R^2) of
// the exact net at that point, to the net's own error.
#pragma once

#include <array>
#include <vector>

#include "mesher/drape/net.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform {

struct OutlineAngles {
  std::vector<double> angle;       // rad; per cell, not a number for whole cells and where the net cannot tell
  std::vector<char> extrapolated;  // per cell: cut, and the net beyond the outline has no place on the tool there
};

// Crossings of the lattice `box` that cut cells need beyond the blank's own, added to `wanted`. `seed` is the mesh's
// crossing that is (0, 0) of the box, which must reach one crossing past the mesh's lattice on every side.
void want_outline_corners(const Mesh& mesh, const std::array<int, 2>& seed, const NetBox& box,
                          std::vector<char>& wanted);

// `mesh` flat.
[[nodiscard]] OutlineAngles outline_angles(const Mesh& mesh, const std::array<int, 2>& seed, const DrapedNet& net);

}  // namespace weaveform
