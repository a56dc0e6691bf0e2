// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/lattice/node_loops.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

void clear(const SlotBlocks& slots, double* const* arrays, int count) {
  for (int k = 0; k < slots.count; ++k)
    for (int a = 0; a < count; ++a) store_lanes(arrays[a] + (slots.block[k] - slots.origin), spread<Lanes>(0.0));
}

void assemble(const int* block, int count, int next, const RowForces& its_row, const RowForces& row_below,
              double* const (&force)[3]) {
  const RowForces here = its_row, below = row_below;
  double* const f[3] = {force[0], force[1], force[2]};
  for (int k = 0; k < count; ++k) {
    const auto n = block_at(block[k]), m = moved(n, -here.origin), b = moved(n, -next - below.origin);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const Lanes along = load<Lanes>(here.along[c], m) - load<Lanes>(here.along[c] - 1, m);
      const Lanes cells = load<Lanes>(here.p[c], m) - load<Lanes>(here.q[c] - 1, m);
      const Lanes cells_below = load<Lanes>(below.q[c], b) - load<Lanes>(below.p[c] - 1, b);
      const Lanes from_below = cells_below - load<Lanes>(below.across[c], b);
      store(f[c], n, along + cells + load<Lanes>(here.across[c], m) + from_below);
    }
  }
}

// Returns m v0^2.
template <class T, class P>
[[gnu::always_inline]] inline T move_nodes(const NodeMotion& nodes, const LeapfrogStep& step, const P& n) {
  T square = spread<T>(0.0);
  const T impulse = step.kick * load<T>(nodes.inverse_mass, n);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const T before = load<T>(nodes.velocity[c], n);
    const T after = step.keep * before + impulse * load<T>(nodes.force[c], n);
    const T middle = 0.5 * (before + after);
    store(nodes.velocity[c], n, after);
    store(nodes.position[c], n, load<T>(nodes.position[c], n) + step.drift * after);
    square += middle * middle;
  }
  return load<T>(nodes.mass, n) * square;
}

void advance(const NodeMotion& its_nodes, const LeapfrogStep& its_step, const int* begin, const int* end, int ranges,
             double (&sums)[lane_count]) {
  const NodeMotion nodes = its_nodes;
  const LeapfrogStep step = its_step;
  Lanes sum = load_lanes(sums);
  double rest = 0.0;
  for (int r = 0; r < ranges; ++r) {
    int n = begin[r];
    for (; n + lane_count <= end[r]; n += lane_count) sum += move_nodes<Lanes>(nodes, step, block_at(n));
    for (; n < end[r]; ++n) rest += move_nodes<double>(nodes, step, n);
  }
  store_lanes(sums, sum);
  sums[0] += rest;
}

}  // namespace

extern const NodeLoops loops_of_nodes;
const NodeLoops loops_of_nodes = {.clear = clear, .assemble = assemble, .advance = advance};

}  // namespace weaveform::WEAVEFORM_SET
