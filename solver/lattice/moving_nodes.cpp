#include "solver/lattice/moving_nodes.hpp"

#include <algorithm>

namespace weaveform {

NodesByWaiting split_by_waiting(const Bands& bands, const std::vector<char>& waits) {
  NodesByWaiting split;
  const int rows = static_cast<int>(bands.nodes.first.size()) - 1;
  for (int j = 0; j < rows; ++j) {
    for (int k = bands.nodes.first[j]; k < bands.nodes.first[j + 1]; ++k) {
      const int block = bands.nodes.item[k];
      const auto first = waits.begin() + block, last = first + vector_width;
      auto& blocks = std::find(first, last, char{1}) == last ? split.free : split.waiting;
      blocks.item.push_back(block);
    }
    split.free.end_row();
    split.waiting.end_row();
  }
  return split;
}

void move_free_nodes(const BandMove& move, int band, int first, int last) {
  const PerRow<int>& free = move.blocks.free;
  move.sums[band] = {};
  move.advance(move.nodes, move.step, free.item.data() + free.first[first], free.first[last] - free.first[first],
               move.sums[band].lane);
}

}  // namespace weaveform
