// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/lattice/node_loops.hpp"

#include "solver/element/lanes.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

template <class Real>
void clear(const SlotBlocks& slots, Real* const* arrays, int count) {
  for (int k = 0; k < slots.count; ++k)
    for (int a = 0; a < count; ++a) store(arrays[a], block_at(slots.block[k] - slots.origin), spread<Lanes>(0.0));
}

// As many numbers of an array as a vector of double precision has, in the array's own precision.
[[gnu::always_inline]] inline Vector as_it_is(const double* p) {
  return *reinterpret_cast<const AnyVector*>(p);
}
[[gnu::always_inline]] inline ShortVector as_it_is(const float* p) {
  return *reinterpret_cast<const AnyShortVector*>(p);
}
[[gnu::always_inline]] inline Vector in_double(const Vector& numbers) {
  return numbers;
}
[[gnu::always_inline]] inline Vector in_double(const ShortVector& numbers) {
  return widened(numbers);
}

// Component c of the force on the nodes of a block that begins at slot n.
template <class Real>
[[gnu::always_inline]] inline Lanes assembled(const RowForces<Real>& here, const RowForces<Real>& below, int next,
                                              int n, int c) {
  Lanes force;
#pragma GCC unroll 8
  for (int i = 0; i < parts_of_block; ++i) {
    const int m = n + i * native_width - here.origin, b = n + i * native_width - next - below.origin;
    const auto along = as_it_is(here.along[c] + m) - as_it_is(here.along[c] + m - 1);
    const auto cells = as_it_is(here.p[c] + m) - as_it_is(here.q[c] + m - 1);
    const auto cells_below = as_it_is(below.q[c] + b) - as_it_is(below.p[c] + b - 1);
    const auto from_below = cells_below - as_it_is(below.across[c] + b);
    force.part[i] = in_double(along + cells + as_it_is(here.across[c] + m) + from_below);
  }
  return force;
}

template <int components, class Real>
void assemble(const int* block, int count, int next, const RowForces<Real>& its_row, const RowForces<Real>& row_below,
              double* const (&force)[3]) {
  const RowForces<Real> here = its_row, below = row_below;
  double* const f[3] = {force[0], force[1], force[2]};
  for (int k = 0; k < count; ++k)
#pragma GCC unroll 3
    for (int c = 0; c < components; ++c) store(f[c], block_at(block[k]), assembled(here, below, next, block[k], c));
}

// Those of a block that begins at slot n, under `force`; returns m v0^2.
template <int components>
[[gnu::always_inline]] inline Lanes move_nodes(const NodeMotion& nodes, const LeapfrogStep& step, int n,
                                               const Lanes (&force)[components]) {
  const auto at = block_at(n);
  Lanes square = spread<Lanes>(0.0);
  const Lanes impulse = step.kick * load<Lanes>(nodes.inverse_mass, at);
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    const Lanes before = load<Lanes>(nodes.velocity[c], at);
    const Lanes after = step.keep * before + impulse * force[c];
    const Lanes middle = 0.5 * (before + after);
    store(nodes.velocity[c], at, after);
    store(nodes.position[c], at, load<Lanes>(nodes.position[c], at) + step.drift * after);
    square += middle * middle;
  }
  return load<Lanes>(nodes.mass, at) * square;
}

template <int components>
void advance(const NodeMotion& its_nodes, const LeapfrogStep& its_step, const int* block, int count,
             double (&sums)[lane_count]) {
  const NodeMotion nodes = its_nodes;
  const LeapfrogStep step = its_step;
  Lanes sum = load_lanes(sums);
  for (int k = 0; k < count; ++k) {
    const auto at = block_at(block[k]);
    Lanes force[components];
#pragma GCC unroll 3
    for (int c = 0; c < components; ++c) force[c] = load<Lanes>(nodes.force[c], at);
    sum += move_nodes(nodes, step, block[k], force);
  }
  store_lanes(sums, sum);
}

template <int components, class Real>
void move(const int* block, int count, int next, const RowForces<Real>& its_row, const RowForces<Real>& row_below,
          const NodeMotion& its_nodes, const LeapfrogStep& its_step, double (&sums)[lane_count]) {
  const RowForces<Real> here = its_row, below = row_below;
  const NodeMotion nodes = its_nodes;
  const LeapfrogStep step = its_step;
  Lanes sum = load_lanes(sums);
  for (int k = 0; k < count; ++k) {
    Lanes force[components];
#pragma GCC unroll 3
    for (int c = 0; c < components; ++c) force[c] = assembled(here, below, next, block[k], c);
    sum += move_nodes(nodes, step, block[k], force);
  }
  store_lanes(sums, sum);
}

}  // namespace

extern const NodeLoops loops_of_nodes;
const NodeLoops loops_of_nodes = {
    .of_double = {.clear = clear<double>, .assemble = assemble<3, double>, .move = move<3, double>},
    .of_single = {.clear = clear<float>, .assemble = assemble<3, float>, .move = move<3, float>},
    .flat = {.clear = clear<double>, .assemble = assemble<2, double>, .move = move<2, double>},
    .advance = advance<3>,
    .advance_flat = advance<2>};

}  // namespace weaveform::WEAVEFORM_SET
