// The inner loop's other half: element forces of a band assembled on the nodes, and the nodes' motion. Compiled once for
// each instruction set (core/instructions), as element_loops.hpp is.
#pragma once

#include "solver/element/lanes.hpp"
#include "solver/lattice/slot_blocks.hpp"

namespace weaveform {

// The force on the node of each slot n, from the elements of its row at slot n - origin and of the row below at
// n - below_origin of theirs:
//   f = along[n] - along[n-1] + p[n] - q[n-1] + across[n]  +  q'[n'] - p'[n'-1] - across'[n'] ,  n' = n - next below
struct RowForces {
  const double *along[3], *across[3], *p[3], *q[3];
  int origin;
};
using AssembleLoop = void (*)(const int* block, int count, int next, const RowForces& here, const RowForces& below,
                              double* const (&force)[3]);

// Zero in the blocks of each of the arrays.
using ClearLoop = void (*)(const SlotBlocks& slots, double* const* arrays, int count);

// One leapfrog step of nodes (Newmark 1959, beta = 0, velocities at half steps), in each component
//   v+ = keep * v- + kick * f / m ,   x+ = x + drift * v+
// and, into the lanes of `sums`, m v0^2 with v0 = (v- + v+)/2.
struct NodeMotion {
  const double *inverse_mass, *mass;  // 1/tonne, tonne; 0 where no node is
  const double* force[3];             // N
  double* velocity[3];
  double* position[3];
};
struct LeapfrogStep {
  double keep, kick, drift;  // 1, s, s
};
// Of the nodes in [begin[r], end[r]).
using AdvanceLoop = void (*)(const NodeMotion& nodes, const LeapfrogStep& step, const int* begin, const int* end,
                             int ranges, double (&sums)[lane_count]);

struct NodeLoops {
  ClearLoop clear;
  AssembleLoop assemble;
  AdvanceLoop advance;
};

// The one for this processor.
[[nodiscard]] const NodeLoops& node_loops();

}  // namespace weaveform
