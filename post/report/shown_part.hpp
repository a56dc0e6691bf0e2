// The part as a page shows it: quadrilaterals and yarns between nodes that are kept. A large lattice is thinned in square
// blocks of its cells; where a block is not whole (edges, holes, cut cells) its cells stay as they are.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

struct ShownPart {
  std::vector<int> node;                 // of the mesh
  std::vector<std::array<int, 4>> cell;  // places in `node`; a triangle has its last one twice
  // The cells of the mesh that a shown one stands for: of[first[c]] .. of[first[c + 1] - 1].
  std::vector<int> first = {0}, of;
  std::array<std::vector<std::array<int, 2>>, 2> yarn;  // places in `node`; warp, weft
};

// With `block` = 1 all cells and yarn elements; else blocks of block x block cells, and the yarns along their sides.
[[nodiscard]] ShownPart shown_part(const Mesh& mesh, int block);

}  // namespace weaveform
