// One family at a bend whose neighbours are anywhere, for the inner loops of bending. Included by files that are compiled
// once for each instruction set: nothing here but what is always inlined.
#pragma once

#include "solver/bending/bend_geometry.hpp"
#include "solver/bending/bend_kernels.hpp"

namespace weaveform {

// Both sides of one family at a loose bend: tangents, and the vector that spans the fabric's plane.
struct LooseYarn {
  double before[3], after[3], span[3];
  double scale_before, scale_after;  // own weight / length
};

[[gnu::always_inline]] inline LooseYarn loose_yarn(const LooseBendView& bends, const double* const (&x)[3], int f,
                                                   int e) {
  const int node = bends.node[e], before = bends.before[f][e], after = bends.after[f][e];
  const double own_before = bends.own_before[f][e], own_after = bends.own_after[f][e];
  const double spread = 1.0 / bends.inverse_spread[f][e];
  double em[3], ep[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    em[c] = x[c][node] - x[c][before];
    ep[c] = x[c][after] - x[c][node];
  }
  const BendTangent tm = bend_tangent(em[0], em[1], em[2]), tp = bend_tangent(ep[0], ep[1], ep[2]);
  LooseYarn yarn{};
  yarn.scale_before = own_before * tm.inverse_length;
  yarn.scale_after = own_after * tp.inverse_length;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double fixed_before = bends.fixed_before[f][c][e], fixed_after = bends.fixed_after[f][c][e];
    yarn.before[c] = own_before * tm.t[c] + fixed_before;
    yarn.after[c] = own_after * tp.t[c] + fixed_after;
    // in the jaws the yarn goes on as far as outside (spread: half an element), so that the normal halves the turn
    yarn.span[c] = em[c] + ep[c] + 2.0 * spread * (fixed_before + fixed_after);
  }
  return yarn;
}

}  // namespace weaveform
