// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/lattice/element_loops.hpp"

#include "solver/state/packed.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

static_assert(lane_count == vector_width, "blocks of slots are packs");

// ---- access: the slots of a loop and what stands there

[[gnu::always_inline]] inline int blocks_of(const RowYarns& yarns) {
  return yarns.slots.count;
}
[[gnu::always_inline]] inline int blocks_of(const ListedYarns& yarns) {
  return yarns.blocks;
}
[[gnu::always_inline]] inline int blocks_of(const RowCells& cells) {
  return cells.slots.count;
}
[[gnu::always_inline]] inline int blocks_of(const ListedCells& cells) {
  return cells.blocks;
}
[[gnu::always_inline]] inline int first_of(const RowYarns& yarns, int k) {
  return yarns.slots.block[k];
}
[[gnu::always_inline]] inline int first_of(const ListedYarns& /*yarns*/, int k) {
  return k * lane_count;
}
[[gnu::always_inline]] inline int first_of(const RowCells& cells, int k) {
  return cells.slots.block[k];
}
[[gnu::always_inline]] inline int first_of(const ListedCells& /*cells*/, int k) {
  return k * lane_count;
}
[[gnu::always_inline]] inline int origin_of(const RowYarns& yarns) {
  return yarns.slots.origin;
}
[[gnu::always_inline]] inline int origin_of(const ListedYarns& /*yarns*/) {
  return 0;
}
[[gnu::always_inline]] inline int origin_of(const RowCells& cells) {
  return cells.slots.origin;
}
[[gnu::always_inline]] inline int origin_of(const ListedCells& /*cells*/) {
  return 0;
}

// How many vectors a loop takes at once, less than a block or blocks of them: several where an element's chain of steps
// leaves the processor waiting, one where more numbers no longer fit its registers. Measured, ns for a block of yarns and
// of cells: AVX-512 1: 17, 40; 2: 22, 30; AVX2 1: 26, -; 2: 37, 52; SSE2 1: 61, -; 2: -, 129; 4: 48, 90.
constexpr int yarns_at_once = native_width == 2 ? 4 : 1, cells_at_once = native_width == 2 ? 4 : 2;
constexpr int at_least_one(int n) {
  return n > 0 ? n : 1;
}
template <int vectors>
constexpr int blocks_at_once = at_least_one(vectors / parts_of_block);
template <int vectors>
constexpr int turns_in_block = at_least_one(parts_of_block / vectors);

// Slots of turn t through the block k, or of the blocks from k on.
template <int vectors, class Elements>
[[gnu::always_inline]] inline Place<vectors> place_of(const Elements& elements, int k, int turn) {
  Place<vectors> place;
#pragma GCC unroll 8
  for (int i = 0; i < vectors; ++i) {
    const int part = turn * vectors + i;
    place.at[i] = first_of(elements, k + part / parts_of_block) + part % parts_of_block * native_width;
  }
  return place;
}

// Calls pass.operator()<vectors>(k, turn) through all blocks.
template <int vectors, class Pass>
[[gnu::always_inline]] inline void through_blocks(int count, const Pass& pass) {
  int k = 0;
  for (; k + blocks_at_once<vectors> <= count; k += blocks_at_once<vectors>)
#pragma GCC unroll 8
    for (int turn = 0; turn < turns_in_block<vectors>; ++turn) pass.template operator()<vectors>(k, turn);
  if constexpr (blocks_at_once < vectors >> 1)
    for (; k < count; ++k) pass.template operator()<parts_of_block>(k, 0);
}

// A pack's numbers into the sums of the lanes that they stand in.
template <int vectors, class Combine>
[[gnu::always_inline]] inline void gather_into(Lanes& sum, const Pack<vectors>& numbers, int turn,
                                               const Combine& combine) {
#pragma GCC unroll 8
  for (int i = 0; i < vectors; ++i) {
    Vector& part = sum.part[(turn * vectors + i) % parts_of_block];
    part = combine(part, numbers.part[i]);
  }
}

[[gnu::always_inline]] inline Vector lesser_vector(const Vector& a, const Vector& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Vector greater_vector(const Vector& a, const Vector& b) {
  return a > b ? a : b;
}

// ---- yarns

struct YarnSums {
  Lanes power, shortest, longest;
};

// The way from the first to the second node and how it changes, mm and mm/s.
template <class T>
struct YarnSpan {
  T way[3], change[3];
};

template <class T, class P>
[[gnu::always_inline]] inline YarnSpan<T> span(const RowYarns& yarns, const NodeArrays& nodes, const P& n) {
  YarnSpan<T> span;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double *x = nodes.position[c], *v = nodes.velocity[c];
    span.way[c] = load<T>(x + yarns.next, n) - load<T>(x, n);
    span.change[c] = load<T>(v + yarns.next, n) - load<T>(v, n);
  }
  return span;
}

template <class T, class P>
[[gnu::always_inline]] inline YarnSpan<T> span(const ListedYarns& yarns, const NodeArrays& nodes, const P& n) {
  YarnSpan<T> span;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double *x = nodes.position[c], *v = nodes.velocity[c];
    span.way[c] = gather<T>(x, yarns.node1, n) - gather<T>(x, yarns.node0, n);
    span.change[c] = gather<T>(v, yarns.node1, n) - gather<T>(v, yarns.node0, n);
  }
  return span;
}

// Force per length and the part of it that is viscous, N/mm; (L/L0)^2 now and ahead, times the unit below.
template <class T>
struct YarnResponse {
  T per_length, viscous, now, coming;
};

template <Section section, class Law, class T, class P>
[[gnu::always_inline]] inline YarnResponse<T> response(const RowYarns& yarns, const Law& law, const YarnStep& step,
                                                       const P& n, const T& square, const T& rate) {
  const T area = load<T>(yarns.section, n);
  T inverse;
  const T elastic = yarn_force_per_length<section>(law, square, spread<T>(yarns.rest), area, inverse);
  const T viscous = viscous_force_per_length(inverse, rate, area, spread<T>(step.viscosity / yarns.rest));
  return {elastic + viscous, viscous, square, square + 2.0 * step.ahead * rate};
}

template <Section section, class Law, class T, class P>
[[gnu::always_inline]] inline YarnResponse<T> response(const ListedYarns& yarns, const Law& law, const YarnStep& step,
                                                       const P& n, const T& square, const T& rate) {
  const T rest = load<T>(yarns.length, n), jaw = load<T>(yarns.jaw, n), area = load<T>(yarns.section, n);
  const T inverse_length = inverse_root(square), inverse_rest = 1.0 / rest;
  const T whole = square * inverse_length + jaw, coming = whole + step.ahead * rate * inverse_length;
  const T stretch = whole * inverse_rest, then = coming * inverse_rest;
  T inverse;
  const T elastic = yarn_force_per_length<section>(law, square, inverse_length, rest, jaw, area, inverse);
  const T viscous = viscous_force_per_length<T>(inverse, rate, area, step.viscosity * inverse_rest);
  return {elastic + viscous, viscous, stretch * stretch, then * then};
}

// Where L^2 is kept instead of (L/L0)^2, that of the length at rest.
[[gnu::always_inline]] inline double unit_of(const RowYarns& yarns) {
  return yarns.rest * yarns.rest;
}
[[gnu::always_inline]] inline double unit_of(const ListedYarns& /*yarns*/) {
  return 1.0;
}

template <class T>
[[gnu::always_inline]] inline void hold(const YarnResponse<T>& r, const T& power, int turn, YarnSums& sums) {
  gather_into(sums.power, power, turn, [](const Vector& a, const Vector& b) { return a + b; });
  gather_into(sums.shortest, lesser(r.now, r.coming), turn, lesser_vector);
  gather_into(sums.longest, greater(r.now, r.coming), turn, greater_vector);
}

template <Section section, int vectors, class Law, class Yarns>
[[gnu::always_inline]] inline void yarn_pass(const Law& law, const Yarns& yarns, const NodeArrays& nodes,
                                             const YarnStep& step, double* const (&force)[3], int k, int turn,
                                             YarnSums& sums) {
  using T = Pack<vectors>;
  const auto n = place_of<vectors>(yarns, k, turn), to = moved(n, -origin_of(yarns));
  const YarnSpan<T> s = span<T>(yarns, nodes, n);
  // what fills up a block has no section, and stands for a yarn at rest
  const auto is_yarn = load<T>(yarns.section, n) > spread<T>(0.0);
  const T rate =
      select(is_yarn, s.way[0] * s.change[0] + s.way[1] * s.change[1] + s.way[2] * s.change[2], spread<T>(0.0));
  const T square =
      select(is_yarn, s.way[0] * s.way[0] + s.way[1] * s.way[1] + s.way[2] * s.way[2], spread<T>(unit_of(yarns)));
  const YarnResponse<T> r = response<section>(yarns, law, step, n, square, rate);
  hold(r, r.viscous * rate, turn, sums);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) store(force[c], to, r.per_length * s.way[c]);
}

template <Section section, class Law, class Yarns>
void yarn_loop(const void* law_pointer, const Yarns& its_yarns, const NodeArrays& its_nodes, const YarnStep& its_step,
               double* const (&t)[3], YarnLanes& totals) {
  const Law law = *static_cast<const Law*>(law_pointer);
  const Yarns yarns = its_yarns;
  const NodeArrays nodes = its_nodes;
  const YarnStep step = its_step;
  double* const force[3] = {t[0], t[1], t[2]};
  const double unit = unit_of(yarns);
  YarnSums sums = {load_lanes(totals.power), load_lanes(totals.shortest) * unit, load_lanes(totals.longest) * unit};
  through_blocks<yarns_at_once>(
      blocks_of(yarns), [&]<int vectors>(int k, int turn) __attribute__((always_inline)) {
        yarn_pass<section, vectors>(law, yarns, nodes, step, force, k, turn, sums);
      });
  store_lanes(totals.power, sums.power);
  store_lanes(totals.shortest, sums.shortest / unit);
  store_lanes(totals.longest, sums.longest / unit);
}

// ---- cells

template <class T>
struct Directions {
  T warp[3], weft[3];
};

// At a full quad's centre from its diagonals d = x11 - x00, e = x10 - x01: g1 = (d + e)/2h1, g2 = (d - e)/2h2. The
// whole-stress formulations ask for directions of any length: s and h ds/dg are those of h g. They get d + e and d - e.
template <class T, class P>
[[gnu::always_inline]] inline Directions<T> directions(const RowCells& cells, const NodeArrays& nodes, const P& n) {
  Directions<T> g;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double *x = nodes.position[c], *up = x + cells.next;
    const T d = load<T>(up + 1, n) - load<T>(x, n), e = load<T>(x + 1, n) - load<T>(up, n);
    g.warp[c] = d + e;
    g.weft[c] = d - e;
  }
  return g;
}

// Of a cut cell from all its nodes, relative to the first, so that a translation leaves the bits alone.
template <class T, class P>
[[gnu::always_inline]] inline Directions<T> directions(const ListedCells& cells, const NodeArrays& nodes, const P& n) {
  constexpr int width = LooseCells::width;
  T first[3];
  Directions<T> g;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    first[c] = gather<T>(nodes.position[c], cells.node, n, width);
    g.warp[c] = g.weft[c] = spread<T>(0.0);
  }
#pragma GCC unroll 8
  for (int a = 1; a < width; ++a) {
    const T c1 = every<T>(cells.warp + a, n, width), c2 = every<T>(cells.weft + a, n, width);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const T offset = gather<T>(nodes.position[c], cells.node + a, n, width) - first[c];
      g.warp[c] += c1 * offset;
      g.weft[c] += c2 * offset;
    }
  }
  return g;
}

// f_a = -(c1_a F1 + c2_a F2): the lower first corner has c = (-, -)/2h, the upper first one (-, +)/2h; without the
// halves and spacings, that the directions do not have either.
template <class T, class P>
[[gnu::always_inline]] inline void write(const RowCells& /*cells*/, const RowCellForces& out, const P& to,
                                         const CellForce<T>& f) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    store(out.p[c], to, f.warp[c] + f.weft[c]);
    store(out.q[c], to, f.warp[c] - f.weft[c]);
  }
}

template <class T, class P>
[[gnu::always_inline]] inline void write(const ListedCells& /*cells*/, const ListedCellForces& out, const P& to,
                                         const CellForce<T>& f) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    store(out.warp[c], to, f.warp[c]);
    store(out.weft[c], to, f.weft[c]);
  }
}

// The greatest sin^2 gamma of these cells and those before; padding has no area and does not count.
template <class T>
[[gnu::always_inline]] inline void hold_shear(const T& square, const T& area, int turn, Lanes& sharpest) {
  const T none = spread<T>(0.0), counted = select(area > none, square, none);
  gather_into(sharpest, counted, turn, greater_vector);
}

template <Formulation formulation, Thickness thickness_kind, int vectors, class Shear, class Cells, class Forces>
[[gnu::always_inline]] inline void cell_pass(const Shear& shear, const Cells& cells, double thickness,
                                             const NodeArrays& nodes, const Forces& forces, int k, int turn,
                                             Lanes& sharpest) {
  using T = Pack<vectors>;
  const auto n = place_of<vectors>(cells, k, turn);
  const Directions<T> g = directions<T>(cells, nodes, n);
  const T area = load<T>(cells.area, n), volume = area * thickness;
  T square;
  const auto f = shear_cell_force<formulation, thickness_kind>(shear, g.warp, g.weft, volume, square);
  write(cells, forces, moved(n, -origin_of(cells)), f);
  hold_shear(square, area, turn, sharpest);
}

template <Formulation formulation, Thickness thickness_kind, class Shear, class Cells, class Forces>
void cell_loop(const void* shear_pointer, const Cells& its_cells, double thickness, const NodeArrays& its_nodes,
               const Forces& its_forces, CellLanes& totals) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const Cells cells = its_cells;
  const NodeArrays nodes = its_nodes;
  const Forces forces = its_forces;
  Lanes sharpest = load_lanes(totals.sharpest);
  through_blocks<cells_at_once>(
      blocks_of(cells), [&]<int vectors>(int k, int turn) __attribute__((always_inline)) {
        cell_pass<formulation, thickness_kind, vectors>(shear, cells, thickness, nodes, forces, k, turn, sharpest);
      });
  store_lanes(totals.sharpest, sharpest);
}

// What turns the directions of a loop into those of the element, and the forces conjugate to these into theirs.
struct Scale {
  double warp, weft;
};
[[gnu::always_inline]] inline Scale scale_of(const RowCells& cells) {
  return {0.5 * cells.inverse_spacing[0], 0.5 * cells.inverse_spacing[1]};
}
[[gnu::always_inline]] inline Scale scale_of(const ListedCells& /*cells*/) {
  return {1.0, 1.0};
}

template <class Pair>
[[gnu::always_inline]] inline Pair scaled(const Pair& pair, const Scale& scale) {
  Pair result;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    result.warp[c] = scale.warp * pair.warp[c];
    result.weft[c] = scale.weft * pair.weft[c];
  }
  return result;
}

[[gnu::always_inline]] inline double shear_square(const double (&g1)[3], const double (&g2)[3]) {
  const double dot = g1[0] * g2[0] + g1[1] * g2[1] + g1[2] * g2[2];
  return dot * dot /
         ((g1[0] * g1[0] + g1[1] * g1[1] + g1[2] * g1[2]) * (g2[0] * g2[0] + g2[1] * g2[1] + g2[2] * g2[2]));
}

[[gnu::always_inline]] inline CellHistory load_history(const HistoryArrays& history, int n) {
  const auto& b = history.before;
  return {{b[0][n], b[1][n], b[2][n]}, {b[3][n], b[4][n], b[5][n]}, b[6][n], b[7][n], b[8][n], b[9][n], b[10][n]};
}

[[gnu::always_inline]] inline void store_history(const HistoryArrays& history, int n, const CellHistory& h) {
  const double value[cell_history_size] = {h.warp[0], h.warp[1], h.warp[2], h.weft[0], h.weft[1], h.weft[2],
                                           h.stress1, h.stress2, h.stress4, h.strain,  h.work};
#pragma GCC unroll 16
  for (int k = 0; k < cell_history_size; ++k) history.after[k][n - history.after_origin] = value[k];
}

template <Frame frame, Thickness thickness_kind, class Shear, class Cells, class Forces>
void history_cell_loop(const void* shear_pointer, const Cells& its_cells, double thickness, int begin, int end,
                       const NodeArrays& its_nodes, const HistoryArrays& arrays, const Forces& its_forces,
                       CellLanes& totals) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const Cells cells = its_cells;
  const NodeArrays nodes = its_nodes;
  const HistoryArrays history = arrays;
  const Forces forces = its_forces;
  double sharpest = totals.sharpest[0];
#pragma omp simd reduction(max : sharpest)
  for (int n = begin; n < end; ++n) {
    const Scale scale = scale_of(cells);
    const Directions<double> g = scaled(directions<double>(cells, nodes, n), scale);
    CellHistory state = load_history(history, n);
    const CellForce<double> force =
        incremental_cell_force<frame, thickness_kind>(shear, g.warp, g.weft, cells.area[n] * thickness, state);
    store_history(history, n, state);
    write(cells, forces, n - origin_of(cells), scaled(force, scale));
    sharpest = greater(shear_square(g.warp, g.weft), sharpest);
  }
  totals.sharpest[0] = sharpest;
}

// ---- which loop a scene takes

template <Frame frame, Thickness thickness>
HistoryCellLoops shaped_history_loops(ShearShape shape) {
  const auto of = []<class Shear>(Shear /*shape*/) -> HistoryCellLoops {
    return {&history_cell_loop<frame, thickness, Shear, RowCells, RowCellForces>,
            &history_cell_loop<frame, thickness, Shear, ListedCells, ListedCellForces>};
  };
  if (shape == ShearShape::general) return of(GeneralShear{});
  return of(StartedShear{});  // the start is the least of what these cost
}

template <Formulation formulation, Thickness thickness>
CellLoops shaped_cell_loops(ShearShape shape) {
  const auto of = []<class Shear>(Shear /*shape*/) -> CellLoops {
    return {&cell_loop<formulation, thickness, Shear, RowCells, RowCellForces>,
            &cell_loop<formulation, thickness, Shear, ListedCells, ListedCellForces>};
  };
  if (shape == ShearShape::general) return of(GeneralShear{});
  return shape == ShearShape::started ? of(StartedShear{}) : of(PaperShear{});
}

template <Section section>
YarnLoops shaped_yarn_loops(bool paper) {
  if (paper) return {&yarn_loop<section, PaperLaw, RowYarns>, &yarn_loop<section, PaperLaw, ListedYarns>};
  return {&yarn_loop<section, GeneralLaw, RowYarns>, &yarn_loop<section, GeneralLaw, ListedYarns>};
}

YarnLoops yarn_loops(Section section, bool paper) {
  return section == Section::incompressible ? shaped_yarn_loops<Section::incompressible>(paper)
                                            : shaped_yarn_loops<Section::constant>(paper);
}

CellLoops cell_loops(Formulation formulation, Thickness thickness, ShearShape shape) {
  const bool constant = thickness == Thickness::constant;
  if (formulation == Formulation::energy)
    return constant ? shaped_cell_loops<Formulation::energy, Thickness::constant>(shape)
                    : shaped_cell_loops<Formulation::energy, Thickness::constant_volume>(shape);
  return constant ? shaped_cell_loops<Formulation::contravariant, Thickness::constant>(shape)
                  : shaped_cell_loops<Formulation::contravariant, Thickness::constant_volume>(shape);
}

HistoryCellLoops history_cell_loops(Frame frame, Thickness thickness, ShearShape shape) {
  const bool constant = thickness == Thickness::constant;
  if (frame == Frame::green_naghdi)
    return constant ? shaped_history_loops<Frame::green_naghdi, Thickness::constant>(shape)
                    : shaped_history_loops<Frame::green_naghdi, Thickness::constant_volume>(shape);
  return constant ? shaped_history_loops<Frame::side, Thickness::constant>(shape)
                  : shaped_history_loops<Frame::side, Thickness::constant_volume>(shape);
}

}  // namespace

extern const ElementLoops loops_of_elements;
const ElementLoops loops_of_elements = {.yarns = yarn_loops, .cells = cell_loops, .history_cells = history_cell_loops};

}  // namespace weaveform::WEAVEFORM_SET
