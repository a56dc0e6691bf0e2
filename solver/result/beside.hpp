// Which cells lie beside which yarn elements, so that one grid of lines and polygons can show every field on both.
#pragma once

#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

// Pairs (yarn element, cell) grouped by yarn: yarn y lies beside cell[offset[y]] .. cell[offset[y+1]-1].
struct CellsBeside {
  std::vector<int> offset = {0};
  std::vector<int> cell;
};

// A cell lies beside a yarn element when both of the element's nodes are the cell's. An element with no such cell (a
// short end whose sliver was merged away) takes the cells at either of its nodes.
[[nodiscard]] CellsBeside cells_beside_yarns(const Mesh& mesh);

// Per yarn, the mean of a cell value over the cells beside it; 0 where there is none.
[[nodiscard]] std::vector<double> mean_on_yarns(const CellsBeside& beside, const std::vector<double>& on_cells);

// Per cell, the mean of a yarn value over the yarn elements beside it; 0 where there is none.
[[nodiscard]] std::vector<double> mean_on_cells(const CellsBeside& beside, const std::vector<double>& on_yarns,
                                                int cell_count);

}  // namespace weaveform
