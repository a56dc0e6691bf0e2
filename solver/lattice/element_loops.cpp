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

// How many vectors of double precision a loop takes at once, or as many numbers in half as many vectors of single
// precision: less than a block or blocks of them. Several where an element's chain of steps leaves the processor waiting,
// one where more numbers no longer fit its registers. Measured, ns for a block of yarns and of cells in double precision:
// AVX-512 1: 17, 40; 2: 22, 30; AVX2 1: 26, -; 2: 37, 52; SSE2 1: 61, -; 2: -, 129; 4: 48, 90.
template <class Real>
constexpr int yarns_at_once = native_width == 2 ? 4 : 1;
template <class Real>
constexpr int cells_at_once = native_width == 2 ? 4 : 2;
template <>
constexpr int yarns_at_once<float> = native_width == 2 ? 4 : 2;
constexpr int at_least_one(int n) {
  return n > 0 ? n : 1;
}
template <int vectors>
constexpr int blocks_at_once = at_least_one(vectors / parts_of_block);
template <int vectors>
constexpr int turns_in_block = at_least_one(parts_of_block / vectors);

// Slots of turn t through the block k, or of the blocks from k on, where numbers of type T stand; `repeated`: of the block
// k, again and again.
template <class T, bool repeated, class Elements>
[[gnu::always_inline]] inline auto place_of(const Elements& elements, int k, int turn) {
  constexpr int vectors = T::width / native_width;
  Place<vectors> place;
#pragma GCC unroll 8
  for (int i = 0; i < vectors; ++i) {
    const int part = turn * vectors + i, further = repeated ? 0 : part / parts_of_block;
    place.at[i] = first_of(elements, k + further) + part % parts_of_block * native_width;
  }
  return place;
}

// Calls pass.operator()<T, repeated>(k, turn) through all blocks, with packs T of `vectors`. At the end, where fewer
// blocks are left, with those of one block; in single precision, which has no narrower ones, with one block repeated, so
// that an element's bits do not depend on which others come with it.
template <int vectors, class Real, class Pass>
[[gnu::always_inline]] inline void through_blocks(int count, const Pass& pass) {
  using T = PackOf<vectors, Real>;
  constexpr bool narrows = std::is_same_v<Real, double>;
  int k = 0;
  for (; k + blocks_at_once<vectors> <= count; k += blocks_at_once<vectors>)
#pragma GCC unroll 8
    for (int turn = 0; turn < turns_in_block<vectors>; ++turn) pass.template operator()<T, false>(k, turn);
  if constexpr (blocks_at_once < vectors >> 1)
    for (; k < count; ++k) pass.template operator()<std::conditional_t<narrows, Lanes, T>, !narrows>(k, 0);
}

// A pack's numbers into the sums of the lanes that they stand in, of `repeated` ones the first.
template <bool repeated, int vectors, class Combine>
[[gnu::always_inline]] inline void gather_into(Lanes& sum, const Pack<vectors>& numbers, int turn,
                                               const Combine& combine) {
#pragma GCC unroll 8
  for (int i = 0; i < (repeated ? parts_of_block : vectors); ++i) {
    Vector& part = sum.part[(turn * vectors + i) % parts_of_block];
    part = combine(part, numbers.part[i]);
  }
}

// What is kept of the packs that a loop takes, and of those at its end.
template <class Main>
struct Kept {
  Main main;
  Lanes end;
  template <class T>
  [[gnu::always_inline]] T& of() {
    if constexpr (std::is_same_v<T, Main>)
      return main;
    else
      return end;
  }
  // All of it, each number in some lane.
  template <class Combine>
  [[gnu::always_inline]] Lanes together(const Combine& combine) const {
    Lanes all = end;
    gather_into<false>(all, widen(main), 0, combine);
    return all;
  }
};

[[gnu::always_inline]] inline Vector lesser_vector(const Vector& a, const Vector& b) {
  return a < b ? a : b;
}
[[gnu::always_inline]] inline Vector greater_vector(const Vector& a, const Vector& b) {
  return a > b ? a : b;
}

// ---- yarns

// Power, and least and greatest squared lengths.
template <class Main>
struct YarnSums {
  Lanes power;
  Kept<Main> shortest, longest;
};

// The way from the first to the second node and how it changes, mm and mm/s.
template <int components, class T>
struct YarnSpan {
  Wide<T> way[components];
  T change[components];
};

template <int components, class T, class P>
[[gnu::always_inline]] inline YarnSpan<components, T> span(const RowYarns& yarns, const NodeArrays& nodes, const P& n) {
  YarnSpan<components, T> span;
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    const double *x = nodes.position[c], *v = nodes.velocity[c];
    span.way[c] = difference<Wide<T>>(x + yarns.next, x, n);
    span.change[c] = difference<T>(v + yarns.next, v, n);
  }
  return span;
}

template <int components, class T, class P>
[[gnu::always_inline]] inline YarnSpan<components, T> span(const ListedYarns& yarns, const NodeArrays& nodes,
                                                           const P& n) {
  YarnSpan<components, T> span;
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    const double *x = nodes.position[c], *v = nodes.velocity[c];
    span.way[c] = gather<Wide<T>>(x, yarns.node1, n) - gather<Wide<T>>(x, yarns.node0, n);
    span.change[c] = narrow<T>(gather<Wide<T>>(v, yarns.node1, n) - gather<Wide<T>>(v, yarns.node0, n));
  }
  return span;
}

// Force per length and the part of it that is viscous, N/mm; (L/L0)^2 now and ahead, times the unit below.
template <class T>
struct YarnResponse {
  T per_length, viscous, now, coming;
};

template <Section section, bool near, class Law, class T, class P>
[[gnu::always_inline]] inline YarnResponse<T> response(const RowYarns& yarns, const Law& law, const YarnStep& step,
                                                       const P& n, const Wide<T>& square, const T& rate) {
  const T area = load<T>(yarns.section, n), length_squared = narrow<T>(square);
  T inverse;
  const T elastic = yarn_force_per_length<section, near>(
      law, length_squared, narrow<T>(square - yarns.rest * yarns.rest), spread<T>(yarns.rest), area, inverse);
  const T viscous = viscous_force_per_length(inverse, rate, area, spread<T>(step.viscosity / yarns.rest));
  return {elastic + viscous, viscous, length_squared, length_squared + 2.0 * step.ahead * rate};
}

template <Section section, bool near, class Law, class T, class P>
[[gnu::always_inline]] inline YarnResponse<T> response(const ListedYarns& yarns, const Law& law, const YarnStep& step,
                                                       const P& n, const Wide<T>& square, const T& rate) {
  const Wide<T> exact_rest = load<Wide<T>>(yarns.length, n), exact_inverse = inverse_root(square),
                exact_whole = square * exact_inverse + load<Wide<T>>(yarns.jaw, n);
  const T excess = narrow<T>(exact_whole * exact_whole - exact_rest * exact_rest);
  const T rest = narrow<T>(exact_rest), whole = narrow<T>(exact_whole), inverse_length = narrow<T>(exact_inverse);
  const T area = load<T>(yarns.section, n), inverse_rest = 1.0 / rest;
  const T coming = whole + step.ahead * rate * inverse_length;
  const T stretch = whole * inverse_rest, then = coming * inverse_rest;
  T inverse;
  const T elastic = jawed_yarn_force_per_length<section, near>(law, whole, excess, inverse_length, rest, area, inverse);
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

template <int components, Section section, bool near, class T, bool repeated, class Law, class Yarns, class Real,
          class Sums>
[[gnu::always_inline]] inline void yarn_pass(const Law& law, const Yarns& yarns, const NodeArrays& nodes,
                                             const YarnStep& step, Real* const (&force)[3], int k, int turn,
                                             Sums& sums) {
  const auto n = place_of<T, repeated>(yarns, k, turn), to = moved(n, -origin_of(yarns));
  const YarnSpan<components, T> s = span<components, T>(yarns, nodes, n);
  T way[components];
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) way[c] = narrow<T>(s.way[c]);
  // what fills up a block has no section, and stands for a yarn at rest
  const T rate = select(load<T>(yarns.section, n) > spread<T>(0.0), dot_product(way, s.change), spread<T>(0.0));
  const Wide<T> square = select(load<Wide<T>>(yarns.section, n) > spread<Wide<T>>(0.0), dot_product(s.way, s.way),
                                spread<Wide<T>>(unit_of(yarns)));
  const YarnResponse<T> r = response<section, near, Law, T>(yarns, law, step, n, square, rate);
  gather_into<repeated>(sums.power, widen<T>(r.viscous * rate), turn,
                        [](const Vector& a, const Vector& b) { return a + b; });
  auto &shortest = sums.shortest.template of<T>(), &longest = sums.longest.template of<T>();
  shortest = lesser(shortest, lesser(r.now, r.coming));
  longest = greater(longest, greater(r.now, r.coming));
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) store(force[c], to, r.per_length * way[c]);
}

template <int components, Section section, bool near, class Law, class Yarns, class Real>
void yarn_loop(const void* law_pointer, const Yarns& its_yarns, const NodeArrays& its_nodes, const YarnStep& its_step,
               Real* const (&t)[3], YarnLanes& totals) {
  constexpr int vectors = yarns_at_once<Real>;
  using Main = PackOf<vectors, Real>;
  const Law law = *static_cast<const Law*>(law_pointer);
  const Yarns yarns = its_yarns;
  const NodeArrays nodes = its_nodes;
  const YarnStep step = its_step;
  Real* const force[3] = {t[0], t[1], t[2]};
  const double unit = unit_of(yarns);
  YarnSums<Main> sums = {load_lanes(totals.power),
                         {spread<Main>(unit), load_lanes(totals.shortest) * unit},
                         {spread<Main>(unit), load_lanes(totals.longest) * unit}};
  through_blocks<vectors, Real>(
      blocks_of(yarns), [&]<class T, bool repeated>(int k, int turn) __attribute__((always_inline)) {
        yarn_pass<components, section, near, T, repeated>(law, yarns, nodes, step, force, k, turn, sums);
      });
  store_lanes(totals.power, sums.power);
  store_lanes(totals.shortest, sums.shortest.together(lesser_vector) / unit);
  store_lanes(totals.longest, sums.longest.together(greater_vector) / unit);
}

// ---- cells

template <class T, int components = 3>
struct Directions {
  T warp[components], weft[components];
};

// At a full quad's centre from its diagonals d = x11 - x00, e = x10 - x01: g1 = (d + e)/2h1, g2 = (d - e)/2h2. The
// whole-stress formulations ask for directions of any length: s and h ds/dg are those of h g. They get d + e and d - e.
template <int components, class T, class P>
[[gnu::always_inline]] inline Directions<T, components> directions(const RowCells& cells, const NodeArrays& nodes,
                                                                   const P& n) {
  Directions<T, components> g;
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    const double *x = nodes.position[c], *up = x + cells.next;
    const T d = difference<T>(up + 1, x, n), e = difference<T>(x + 1, up, n);
    g.warp[c] = d + e;
    g.weft[c] = d - e;
  }
  return g;
}

// Of a cut cell from all its nodes, relative to the first, so that a translation leaves the bits alone.
template <int components, class T, class P>
[[gnu::always_inline]] inline Directions<T, components> directions(const ListedCells& cells, const NodeArrays& nodes,
                                                                   const P& n) {
  constexpr int width = LooseCells::width;
  Wide<T> first[components];
  Directions<T, components> g;
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    first[c] = gather<Wide<T>>(nodes.position[c], cells.node, n, width);
    g.warp[c] = g.weft[c] = spread<T>(0.0);
  }
#pragma GCC unroll 8
  for (int a = 1; a < width; ++a) {
    const T c1 = every<T>(cells.warp + a, n, width), c2 = every<T>(cells.weft + a, n, width);
#pragma GCC unroll 3
    for (int c = 0; c < components; ++c) {
      const T offset = narrow<T>(gather<Wide<T>>(nodes.position[c], cells.node + a, n, width) - first[c]);
      g.warp[c] += c1 * offset;
      g.weft[c] += c2 * offset;
    }
  }
  return g;
}

// f_a = -(c1_a F1 + c2_a F2): the lower first corner has c = (-, -)/2h, the upper first one (-, +)/2h; without the
// halves and spacings, that the directions do not have either.
template <class T, int components, class P, class Real>
[[gnu::always_inline]] inline void write(const RowCells& /*cells*/, const RowCellForces<Real>& out, const P& to,
                                         const CellForce<T, components>& f) {
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    store(out.p[c], to, f.warp[c] + f.weft[c]);
    store(out.q[c], to, f.warp[c] - f.weft[c]);
  }
}

template <class T, int components, class P, class Real>
[[gnu::always_inline]] inline void write(const ListedCells& /*cells*/, const ListedCellForces<Real>& out, const P& to,
                                         const CellForce<T, components>& f) {
#pragma GCC unroll 3
  for (int c = 0; c < components; ++c) {
    store(out.warp[c], to, f.warp[c]);
    store(out.weft[c], to, f.weft[c]);
  }
}

template <int components, Formulation formulation, Thickness thickness_kind, class T, bool repeated, class Shear,
          class Cells, class Forces, class Sharpest>
[[gnu::always_inline]] inline void cell_pass(const Shear& shear, const Cells& cells, double thickness,
                                             const NodeArrays& nodes, const Forces& forces, int k, int turn,
                                             Sharpest& sharpest) {
  const auto n = place_of<T, repeated>(cells, k, turn);
  const Directions<T, components> g = directions<components, T>(cells, nodes, n);
  const T area = load<T>(cells.area, n), none = spread<T>(0.0);
  T square;
  const auto f =
      shear_cell_force<formulation, thickness_kind, Shear, T>(shear, g.warp, g.weft, area * thickness, square);
  write(cells, forces, moved(n, -origin_of(cells)), f);
  // padding has no area and does not count
  T& greatest = sharpest.template of<T>();
  greatest = greater(greatest, select(area > none, square, none));
}

template <int components, Formulation formulation, Thickness thickness_kind, class Real, class Shear, class Cells,
          class Forces>
void cell_loop(const void* shear_pointer, const Cells& its_cells, double thickness, const NodeArrays& its_nodes,
               const Forces& its_forces, CellLanes& totals) {
  constexpr int vectors = cells_at_once<Real>;
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const Cells cells = its_cells;
  const NodeArrays nodes = its_nodes;
  const Forces forces = its_forces;
  Kept<PackOf<vectors, Real>> sharpest = {spread<PackOf<vectors, Real>>(0.0), load_lanes(totals.sharpest)};
  through_blocks<vectors, Real>(
      blocks_of(cells), [&]<class T, bool repeated>(int k, int turn) __attribute__((always_inline)) {
        cell_pass<components, formulation, thickness_kind, T, repeated>(shear, cells, thickness, nodes, forces, k, turn,
                                                                        sharpest);
      });
  store_lanes(totals.sharpest, sharpest.together(greater_vector));
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
    const Directions<double> g = scaled(directions<3, double>(cells, nodes, n), scale);
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
    return {&history_cell_loop<frame, thickness, Shear, RowCells, RowCellForces<double>>,
            &history_cell_loop<frame, thickness, Shear, ListedCells, ListedCellForces<double>>};
  };
  if (shape == ShearShape::general) return of(GeneralShear{});
  return of(StartedShear{});  // the start is the least of what these cost
}

template <class Real, Formulation formulation, Thickness thickness>
CellLoops<Real> shaped_cell_loops(ShearShape shape) {
  const auto of = []<class Shear>(Shear /*shape*/) -> CellLoops<Real> {
    return {&cell_loop<3, formulation, thickness, Real, Shear, RowCells, RowCellForces<Real>>,
            &cell_loop<3, formulation, thickness, Real, Shear, ListedCells, ListedCellForces<Real>>};
  };
  if (shape == ShearShape::general) return of(GeneralShear{});
  return shape == ShearShape::started ? of(StartedShear{}) : of(PaperShear{});
}

template <int components, class Real, Section section, class Law>
YarnLoops<Real> loops_for_yarns() {
  return {{&yarn_loop<components, section, true, Law, RowYarns, Real>,
           &yarn_loop<components, section, false, Law, RowYarns, Real>},
          {&yarn_loop<components, section, true, Law, ListedYarns, Real>,
           &yarn_loop<components, section, false, Law, ListedYarns, Real>}};
}

template <class Real>
YarnLoops<Real> yarn_loops(Section section, bool paper) {
  if (section == Section::incompressible)
    return paper ? loops_for_yarns<3, Real, Section::incompressible, PaperLaw>()
                 : loops_for_yarns<3, Real, Section::incompressible, GeneralLaw>();
  return paper ? loops_for_yarns<3, Real, Section::constant, PaperLaw>()
               : loops_for_yarns<3, Real, Section::constant, GeneralLaw>();
}

template <class Real>
CellLoops<Real> cell_loops(Formulation formulation, Thickness thickness, ShearShape shape) {
  const bool constant = thickness == Thickness::constant;
  if (formulation == Formulation::energy)
    return constant ? shaped_cell_loops<Real, Formulation::energy, Thickness::constant>(shape)
                    : shaped_cell_loops<Real, Formulation::energy, Thickness::constant_volume>(shape);
  return constant ? shaped_cell_loops<Real, Formulation::contravariant, Thickness::constant>(shape)
                  : shaped_cell_loops<Real, Formulation::contravariant, Thickness::constant_volume>(shape);
}

YarnLoops<double> flat_yarn_loops(Section section, bool paper) {
  if (section != Section::incompressible || !paper) return {};
  return loops_for_yarns<2, double, Section::incompressible, PaperLaw>();
}

CellLoops<double> flat_cell_loops(Formulation formulation, Thickness thickness, ShearShape shape) {
  const auto of = []<class Shear>(Shear /*shape*/) -> CellLoops<double> {
    constexpr auto energy = Formulation::energy;
    constexpr auto constant_volume = Thickness::constant_volume;
    return {&cell_loop<2, energy, constant_volume, double, Shear, RowCells, RowCellForces<double>>,
            &cell_loop<2, energy, constant_volume, double, Shear, ListedCells, ListedCellForces<double>>};
  };
  if (formulation != Formulation::energy || thickness != Thickness::constant_volume || shape == ShearShape::general)
    return {};
  return shape == ShearShape::started ? of(StartedShear{}) : of(PaperShear{});
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
const ElementLoops loops_of_elements = {.of_double = {.yarns = yarn_loops<double>, .cells = cell_loops<double>},
                                        .of_single = {.yarns = yarn_loops<float>, .cells = cell_loops<float>},
                                        .flat = {.yarns = flat_yarn_loops, .cells = flat_cell_loops},
                                        .history_cells = history_cell_loops};

}  // namespace weaveform::WEAVEFORM_SET
