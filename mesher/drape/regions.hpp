// Marked entries of a grid gathered into connected regions, so that a report names places and not thousands of nodes.
#pragma once

#include <array>
#include <vector>

namespace weaveform {

struct Region {
  std::array<int, 2> first = {0, 0};  // one of its entries: the one nearest to the given centre, counted along the grid
  int count = 0;
};

// Neighbours share a side or a corner. Largest first.
[[nodiscard]] std::vector<Region> connected_regions(const std::vector<char>& marked, const std::array<int, 2>& size,
                                                    const std::array<int, 2>& centre);

}  // namespace weaveform
