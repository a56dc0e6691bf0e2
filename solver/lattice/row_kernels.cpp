#include "solver/lattice/row_kernels.hpp"

#include "solver/state/packed.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

// The least and greatest (L/L0)^2 of this yarn and those before it, now and ahead; padding has no section and does not
// count.
[[gnu::always_inline]] inline void hold(double now, double coming, double section, double& shortest, double& longest) {
  const double less = now < coming ? now : coming, more = now < coming ? coming : now;
  const double low = section > 0.0 ? less : 1.0, high = section > 0.0 ? more : 1.0;
  shortest = low < shortest ? low : shortest;
  longest = high > longest ? high : longest;
}

// Likewise the greatest sin^2 gamma of cells.
[[gnu::always_inline]] inline void hold_shear(double square, double area, double& sharpest) {
  const double counted = area > 0.0 ? square : 0.0;
  sharpest = counted > sharpest ? counted : sharpest;
}

[[gnu::always_inline]] inline double shear_square(const double (&g1)[3], const double (&g2)[3]) {
  const double dot = g1[0] * g2[0] + g1[1] * g2[1] + g1[2] * g2[2];
  return dot * dot /
         ((g1[0] * g1[0] + g1[1] * g1[1] + g1[2] * g1[2]) * (g2[0] * g2[0] + g2[1] * g2[1] + g2[2] * g2[2]));
}

template <Section section, class Law>
YarnSums yarn_row(const void* law_pointer, const RowPair& rows, const RowPair& velocity, double rest, double viscosity,
                  double ahead, const double* area, int begin, int end, double* const (&t)[3]) {
  const Law law = *static_cast<const Law*>(law_pointer);
  const double *ax = rows.a[0], *ay = rows.a[1], *az = rows.a[2];
  const double *bx = rows.b[0], *by = rows.b[1], *bz = rows.b[2];
  const double *avx = velocity.a[0], *avy = velocity.a[1], *avz = velocity.a[2];
  const double *bvx = velocity.b[0], *bvy = velocity.b[1], *bvz = velocity.b[2];
  double *tx = t[0], *ty = t[1], *tz = t[2];
  const double inverse_square = 1.0 / (rest * rest), viscosity_over_rest = viscosity / rest;
  double power = 0.0, shortest = 1.0, longest = 1.0;
#pragma omp simd reduction(+ : power) reduction(min : shortest) reduction(max : longest)
  for (int i = begin; i < end; ++i) {
    const double dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
    const double rate = dx * (bvx[i] - avx[i]) + dy * (bvy[i] - avy[i]) + dz * (bvz[i] - avz[i]);
    const double length_squared = dx * dx + dy * dy + dz * dz;
    const double square = length_squared > least_square ? length_squared : least_square;
    hold(square * inverse_square, (square + 2.0 * ahead * rate) * inverse_square, area[i], shortest, longest);
    double inverse = 0.0;
    const double elastic = yarn_force_per_length<section>(law, square, rest, area[i], inverse);
    const double viscous = viscous_force_per_length(inverse, rate, area[i], viscosity_over_rest);
    const double per_length = elastic + viscous;
    power += viscous * rate;
    tx[i] = per_length * dx;
    ty[i] = per_length * dy;
    tz[i] = per_length * dz;
  }
  return {power, shortest, longest};
}

template <Section section, class Law>
YarnSums loose_yarns(const void* law_pointer, const LooseYarnView& yarns, double viscosity, double ahead,
                     const double* const (&x)[3], const double* const (&v)[3], double* const (&t)[3]) {
  const Law law = *static_cast<const Law*>(law_pointer);
  const double *px = x[0], *py = x[1], *pz = x[2];
  const double *vx = v[0], *vy = v[1], *vz = v[2];
  double *tx = t[0], *ty = t[1], *tz = t[2];
  const int *node0 = yarns.node0, *node1 = yarns.node1;
  const double *length = yarns.length, *jaw = yarns.jaw, *sections = yarns.section;
  double power = 0.0, shortest = 1.0, longest = 1.0;
#pragma omp simd reduction(+ : power) reduction(min : shortest) reduction(max : longest)
  for (int e = 0; e < yarns.count; ++e) {
    const int a = node0[e], b = node1[e];
    const double dx = px[b] - px[a], dy = py[b] - py[a], dz = pz[b] - pz[a];
    const double rate = dx * (vx[b] - vx[a]) + dy * (vy[b] - vy[a]) + dz * (vz[b] - vz[a]);
    const double square = dx * dx + dy * dy + dz * dz;
    const double free = std::sqrt(square), whole = free + jaw[e], coming = whole + ahead * rate / free;
    const double inverse_rest = 1.0 / length[e];
    const double now = whole * inverse_rest, then = coming * inverse_rest;
    hold(now * now, then * then, sections[e], shortest, longest);
    double inverse = 0.0;
    const double elastic = yarn_force_per_length<section>(law, square, length[e], jaw[e], sections[e], inverse);
    const double viscous = viscous_force_per_length(inverse, rate, sections[e], viscosity * inverse_rest);
    const double per_length = elastic + viscous;
    power += viscous * rate;
    tx[e] = per_length * dx;
    ty[e] = per_length * dy;
    tz[e] = per_length * dz;
  }
  return {power, shortest, longest};
}

// Directions at a full quad's centre from its diagonals d = x11 - x00, e = x10 - x01: g1 = (d + e)/2h1, g2 = (d -
// e)/2h2.
struct Directions {
  double warp[3], weft[3];
};

[[gnu::always_inline]] inline Directions quad_directions(const RowPair& rows, int i, double half1, double half2) {
  Directions g;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double d = rows.b[c][i + 1] - rows.a[c][i], e = rows.a[c][i + 1] - rows.b[c][i];
    g.warp[c] = half1 * (d + e);
    g.weft[c] = half2 * (d - e);
  }
  return g;
}

// f_a = -(c1_a F1 + c2_a F2): the lower first corner has c = (-, -)/2h, the upper first one (-, +)/2h.
[[gnu::always_inline]] inline void write_quad(const CellRowOutput& out, int i, double half1, double half2,
                                              const CellForce& f) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    out.p[c][i] = half1 * f.warp[c] + half2 * f.weft[c];
    out.q[c][i] = half1 * f.warp[c] - half2 * f.weft[c];
  }
}

template <Formulation formulation, Thickness thickness_kind, class Shear>
double cell_row(const void* shear_pointer, const RowPair& row_pair, double inverse1, double inverse2,
                const double* area, double thickness, int begin, int end, const CellRowOutput& output) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const RowPair rows = row_pair;
  const CellRowOutput out = output;
  const double half1 = 0.5 * inverse1, half2 = 0.5 * inverse2;
  double sharpest = 0.0;
#pragma omp simd reduction(max : sharpest)
  for (int i = begin; i < end; ++i) {
    const Directions g = quad_directions(rows, i, half1, half2);
    double square = 0.0;
    write_quad(out, i, half1, half2,
               shear_cell_force<formulation, thickness_kind>(shear, g.warp, g.weft, area[i] * thickness, square));
    hold_shear(square, area[i], sharpest);
  }
  return sharpest;
}

[[gnu::always_inline]] inline CellHistory load_history(const HistoryArrays& history, int i) {
  const auto& b = history.before;
  return {{b[0][i], b[1][i], b[2][i]}, {b[3][i], b[4][i], b[5][i]}, b[6][i], b[7][i], b[8][i], b[9][i], b[10][i]};
}

[[gnu::always_inline]] inline void store_history(const HistoryArrays& history, int i, const CellHistory& h) {
  const double value[cell_history_size] = {h.warp[0], h.warp[1], h.warp[2], h.weft[0], h.weft[1], h.weft[2],
                                           h.stress1, h.stress2, h.stress4, h.strain,  h.work};
#pragma GCC unroll 16
  for (int k = 0; k < cell_history_size; ++k) history.after[k][i] = value[k];
}

template <Frame frame, Thickness thickness_kind, class Shear>
double history_cell_row(const void* shear_pointer, const RowPair& row_pair, double inverse1, double inverse2,
                        const double* area, double thickness, int begin, int end, const HistoryArrays& arrays,
                        const CellRowOutput& output) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const RowPair rows = row_pair;
  const HistoryArrays history = arrays;
  const CellRowOutput out = output;
  const double half1 = 0.5 * inverse1, half2 = 0.5 * inverse2;
  double sharpest = 0.0;
#pragma omp simd reduction(max : sharpest)
  for (int i = begin; i < end; ++i) {
    const Directions g = quad_directions(rows, i, half1, half2);
    CellHistory state = load_history(history, i);
    const CellForce force =
        incremental_cell_force<frame, thickness_kind>(shear, g.warp, g.weft, area[i] * thickness, state);
    store_history(history, i, state);
    write_quad(out, i, half1, half2, force);
    hold_shear(shear_square(g.warp, g.weft), area[i], sharpest);
  }
  return sharpest;
}

// Directions of a cut cell from all its nodes, relative to the first, so that a translation leaves the bits alone.
[[gnu::always_inline]] inline Directions loose_directions(const LooseCellView& cells, const double* const (&x)[3],
                                                          int cell) {
  constexpr int width = LooseCells::width;
  Directions g{};
  const int first = cells.node[cell * width];
#pragma GCC unroll 8
  for (int a = 1; a < width; ++a) {
    const int n = cells.node[cell * width + a];
    const double c1 = cells.warp[cell * width + a], c2 = cells.weft[cell * width + a];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const double offset = x[c][n] - x[c][first];
      g.warp[c] += c1 * offset;
      g.weft[c] += c2 * offset;
    }
  }
  return g;
}

[[gnu::always_inline]] inline void write_loose(double* const (&warp_force)[3], double* const (&weft_force)[3], int cell,
                                               const CellForce& force) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    warp_force[c][cell] = force.warp[c];
    weft_force[c][cell] = force.weft[c];
  }
}

template <Formulation formulation, Thickness thickness_kind, class Shear>
double loose_cells(const void* shear_pointer, const LooseCellView& view, double thickness,
                   const double* const (&positions)[3], double* const (&warp_force)[3],
                   double* const (&weft_force)[3]) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const LooseCellView cells = view;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  double* const warp[3] = {warp_force[0], warp_force[1], warp_force[2]};
  double* const weft[3] = {weft_force[0], weft_force[1], weft_force[2]};
  double sharpest = 0.0;
#pragma omp simd reduction(max : sharpest)
  for (int c = 0; c < cells.count; ++c) {
    const Directions g = loose_directions(cells, x, c);
    double square = 0.0;
    write_loose(
        warp, weft, c,
        shear_cell_force<formulation, thickness_kind>(shear, g.warp, g.weft, cells.area[c] * thickness, square));
    hold_shear(square, cells.area[c], sharpest);
  }
  return sharpest;
}

template <Frame frame, Thickness thickness_kind, class Shear>
double history_loose_cells(const void* shear_pointer, const LooseCellView& view, double thickness,
                           const double* const (&positions)[3], const HistoryArrays& arrays,
                           double* const (&warp_force)[3], double* const (&weft_force)[3]) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const LooseCellView cells = view;
  const HistoryArrays history = arrays;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  double* const warp[3] = {warp_force[0], warp_force[1], warp_force[2]};
  double* const weft[3] = {weft_force[0], weft_force[1], weft_force[2]};
  double sharpest = 0.0;
#pragma omp simd reduction(max : sharpest)
  for (int c = 0; c < cells.count; ++c) {
    const Directions g = loose_directions(cells, x, c);
    CellHistory state = load_history(history, c);
    const CellForce force =
        incremental_cell_force<frame, thickness_kind>(shear, g.warp, g.weft, cells.area[c] * thickness, state);
    store_history(history, c, state);
    write_loose(warp, weft, c, force);
    hold_shear(shear_square(g.warp, g.weft), cells.area[c], sharpest);
  }
  return sharpest;
}

template <Frame frame, Thickness thickness>
HistoryCellKernels shaped_history_kernels(ShearShape shape) {
  const auto of = []<class Shear>(Shear /*shape*/) -> HistoryCellKernels {
    return {&history_cell_row<frame, thickness, Shear>, &history_loose_cells<frame, thickness, Shear>};
  };
  if (shape == ShearShape::general) return of(GeneralShear{});
  return of(StartedShear{});  // the start is the least of what these cost
}

template <Formulation formulation, Thickness thickness>
CellKernels shaped_cell_kernels(ShearShape shape) {
  const auto of = []<class Shear>(Shear /*shape*/) -> CellKernels {
    return {&cell_row<formulation, thickness, Shear>, &loose_cells<formulation, thickness, Shear>};
  };
  if (shape == ShearShape::general) return of(GeneralShear{});
  return shape == ShearShape::started ? of(StartedShear{}) : of(PaperShear{});
}

template <Section section>
YarnKernels shaped_yarn_kernels(bool paper) {
  if (paper) return {&yarn_row<section, PaperLaw>, &loose_yarns<section, PaperLaw>};
  return {&yarn_row<section, GeneralLaw>, &loose_yarns<section, GeneralLaw>};
}

YarnKernels yarn_kernels(Section section, bool paper) {
  return section == Section::incompressible ? shaped_yarn_kernels<Section::incompressible>(paper)
                                            : shaped_yarn_kernels<Section::constant>(paper);
}

CellKernels cell_kernels(Formulation formulation, Thickness thickness, ShearShape shape) {
  const bool constant = thickness == Thickness::constant;
  if (formulation == Formulation::energy)
    return constant ? shaped_cell_kernels<Formulation::energy, Thickness::constant>(shape)
                    : shaped_cell_kernels<Formulation::energy, Thickness::constant_volume>(shape);
  return constant ? shaped_cell_kernels<Formulation::contravariant, Thickness::constant>(shape)
                  : shaped_cell_kernels<Formulation::contravariant, Thickness::constant_volume>(shape);
}

HistoryCellKernels history_cell_kernels(Frame frame, Thickness thickness, ShearShape shape) {
  const bool constant = thickness == Thickness::constant;
  if (frame == Frame::green_naghdi)
    return constant ? shaped_history_kernels<Frame::green_naghdi, Thickness::constant>(shape)
                    : shaped_history_kernels<Frame::green_naghdi, Thickness::constant_volume>(shape);
  return constant ? shaped_history_kernels<Frame::side, Thickness::constant>(shape)
                  : shaped_history_kernels<Frame::side, Thickness::constant_volume>(shape);
}

void assemble_row(const double* along, const double* across, const double* p, const double* q, double* carry,
                  double* force, int begin, int end) {
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    force[i] = (along[i] - along[i - 1]) + (p[i] - q[i - 1]) + across[i] + carry[i];
    carry[i] = (q[i] - p[i - 1]) - across[i];
  }
}

void carry_row(const double* across, const double* p, const double* q, double* carry, int begin, int end) {
#pragma omp simd
  for (int i = begin; i < end; ++i) carry[i] = (q[i] - p[i - 1]) - across[i];
}

void advance(const double* inverse_mass, const double* mass, const double* force, double* velocity, double* position,
             double keep, double kick, double drift, int begin, int end, double* sums) {
  constexpr int lanes = 8;
  double lane[lanes] = {};
  int n = begin;
  for (; n + lanes <= end; n += lanes) {
#pragma omp simd
    for (int l = 0; l < lanes; ++l) {
      const double before = velocity[n + l];
      const double after = keep * before + kick * inverse_mass[n + l] * force[n + l];
      const double middle = 0.5 * (before + after);
      velocity[n + l] = after;
      position[n + l] += drift * after;
      lane[l] += mass[n + l] * middle * middle;
    }
  }
  for (int l = 0; n < end; ++n, ++l) {
    const double before = velocity[n];
    const double after = keep * before + kick * inverse_mass[n] * force[n];
    const double middle = 0.5 * (before + after);
    velocity[n] = after;
    position[n] += drift * after;
    lane[l] += mass[n] * middle * middle;
  }
  for (int l = 0; l < lanes; ++l) sums[l] += lane[l];
}

}  // namespace

extern const RowLoops row_loops;
const RowLoops row_loops = {.yarn_kernels = yarn_kernels,
                            .cell_kernels = cell_kernels,
                            .history_cell_kernels = history_cell_kernels,
                            .assemble_row = assemble_row,
                            .carry_row = carry_row,
                            .advance = advance};

}  // namespace weaveform::WEAVEFORM_SET
