// The lattice's nodes on the move. Where nothing but the lattice's own elements pulls at a node, its motion may follow
// its force in the same pass over memory, band after band: a large blank then moves its bytes once a step. The others
// wait until everything has pulled.
#pragma once

#include <vector>

#include "solver/lattice/bands.hpp"
#include "solver/lattice/node_loops.hpp"

namespace weaveform {

// The blocks of Bands::nodes, those that hold a waiting node and those that hold none.
struct NodesByWaiting {
  PerRow<int> free, waiting;
};
// `waits`: per packed node.
[[nodiscard]] NodesByWaiting split_by_waiting(const Bands& bands, const std::vector<char>& waits);

// Sums over some nodes, kept for each lane.
struct LaneSums {
  double lane[lane_count] = {};
};

// How to move the nodes of a band: `sums`, one per band, get what AdvanceLoop adds up over its free ones.
struct BandMove {
  const NodesByWaiting& blocks;
  NodeMotion nodes;
  LeapfrogStep step;
  AdvanceLoop advance;  // of all components, or of those that a flat scene has
  std::vector<LaneSums>& sums;
};

// Of rows first <= j < last, from the forces in `move.nodes`.
void move_free_nodes(const BandMove& move, int band, int first, int last);

}  // namespace weaveform
