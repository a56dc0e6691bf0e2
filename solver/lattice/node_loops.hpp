// The inner loop's other half: element forces of a band assembled on the nodes, and the nodes' motion. Compiled once for
// each instruction set (core/instructions), as element_loops.hpp is.
#pragma once

#include "solver/element/lane_count.hpp"
#include "solver/lattice/slot_blocks.hpp"

namespace weaveform {

// The force on the node of each slot n, from the elements of its row at slot n - origin and of the row below at
// n - below_origin of theirs:
//   f = along[n] - along[n-1] + p[n] - q[n-1] + across[n]  +  q'[n'] - p'[n'-1] - across'[n'] ,  n' = n - next below
template <class Real>
struct RowForces {
  const Real *along[3], *across[3], *p[3], *q[3];
  int origin;
};
template <class Real>
using AssembleLoop = void (*)(const int* block, int count, int next, const RowForces<Real>& here,
                              const RowForces<Real>& below, double* const (&force)[3]);

// Zero in the blocks of each of the arrays.
template <class Real>
using ClearLoop = void (*)(const SlotBlocks& slots, Real* const* arrays, int count);

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
// Of the nodes in the blocks.
using AdvanceLoop = void (*)(const NodeMotion& nodes, const LeapfrogStep& step, const int* block, int count,
                             double (&sums)[lane_count]);
// Both at once: the assembled forces go to the nodes and nowhere else (`nodes` has none).
template <class Real>
using MoveLoop = void (*)(const int* block, int count, int next, const RowForces<Real>& here,
                          const RowForces<Real>& below, const NodeMotion& nodes, const LeapfrogStep& step,
                          double (&sums)[lane_count]);

// Of element forces in double or in single precision.
template <class Real>
struct ForceLoops {
  ClearLoop<Real> clear;
  AssembleLoop<Real> assemble;
  MoveLoop<Real> move;
};

struct NodeLoops {
  ForceLoops<double> of_double;
  ForceLoops<float> of_single;
  ForceLoops<double> flat;  // of x and y alone (element_loops.hpp)
  AdvanceLoop advance;
  AdvanceLoop advance_flat;

  template <class Real>
  [[nodiscard]] const ForceLoops<Real>& of() const {
    if constexpr (sizeof(Real) == sizeof(double))
      return of_double;
    else
      return of_single;
  }
};

// The one for this processor.
[[nodiscard]] const NodeLoops& node_loops();

}  // namespace weaveform
