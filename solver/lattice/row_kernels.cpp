#include "solver/lattice/row_kernels.hpp"

#include "solver/lattice/packed.hpp"

namespace weaveform {
namespace {

template <Section section, class Law>
void yarn_row(const void* law_pointer, const RowPair& rows, double rest, const double* area, int begin, int end,
              double* const (&t)[3]) {
  const Law law = *static_cast<const Law*>(law_pointer);
  const double *ax = rows.a[0], *ay = rows.a[1], *az = rows.a[2];
  const double *bx = rows.b[0], *by = rows.b[1], *bz = rows.b[2];
  double *tx = t[0], *ty = t[1], *tz = t[2];
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    const double dx = bx[i] - ax[i], dy = by[i] - ay[i], dz = bz[i] - az[i];
    const double per_length = yarn_force_per_length<section>(law, dx * dx + dy * dy + dz * dz, rest, area[i]);
    tx[i] = per_length * dx;
    ty[i] = per_length * dy;
    tz[i] = per_length * dz;
  }
}

template <Section section, class Law>
void loose_yarns(const void* law_pointer, const LooseYarnView& yarns, const double* const (&x)[3], double* const (&t)[3]) {
  const Law law = *static_cast<const Law*>(law_pointer);
  const double *px = x[0], *py = x[1], *pz = x[2];
  double *tx = t[0], *ty = t[1], *tz = t[2];
  const int *node0 = yarns.node0, *node1 = yarns.node1;
  const double *length = yarns.length, *jaw = yarns.jaw, *sections = yarns.section;
#pragma omp simd
  for (int e = 0; e < yarns.count; ++e) {
    const int a = node0[e], b = node1[e];
    const double dx = px[b] - px[a], dy = py[b] - py[a], dz = pz[b] - pz[a];
    const double per_length =
        yarn_force_per_length<section>(law, dx * dx + dy * dy + dz * dz, length[e], jaw[e], sections[e]);
    tx[e] = per_length * dx;
    ty[e] = per_length * dy;
    tz[e] = per_length * dz;
  }
}

template <Formulation formulation, Thickness thickness_kind, class Shear>
void cell_row(const void* shear_pointer, const RowPair& rows, double inverse1, double inverse2, const double* area,
              double thickness, int begin, int end, const CellRowOutput& out) {
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const double *lx = rows.a[0], *ly = rows.a[1], *lz = rows.a[2];
  const double *ux = rows.b[0], *uy = rows.b[1], *uz = rows.b[2];
  double *px = out.p[0], *py = out.p[1], *pz = out.p[2];
  double *qx = out.q[0], *qy = out.q[1], *qz = out.q[2];
  const double half1 = 0.5 * inverse1, half2 = 0.5 * inverse2;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    // diagonals d = x11 - x00, e = x10 - x01; the centre's directions are g1 = (d + e)/2h1, g2 = (d - e)/2h2
    const double dx = ux[i + 1] - lx[i], dy = uy[i + 1] - ly[i], dz = uz[i + 1] - lz[i];
    const double ex = lx[i + 1] - ux[i], ey = ly[i + 1] - uy[i], ez = lz[i + 1] - uz[i];
    const double g1[3] = {half1 * (dx + ex), half1 * (dy + ey), half1 * (dz + ez)};
    const double g2[3] = {half2 * (dx - ex), half2 * (dy - ey), half2 * (dz - ez)};
    const CellForce force = shear_cell_force<formulation, thickness_kind>(shear, g1, g2, area[i] * thickness);
    // f_a = -(c1_a F1 + c2_a F2): x00 has c = (-,-)/2h, x01 has (-,+)
    px[i] = half1 * force.warp[0] + half2 * force.weft[0];
    py[i] = half1 * force.warp[1] + half2 * force.weft[1];
    pz[i] = half1 * force.warp[2] + half2 * force.weft[2];
    qx[i] = half1 * force.warp[0] - half2 * force.weft[0];
    qy[i] = half1 * force.warp[1] - half2 * force.weft[1];
    qz[i] = half1 * force.warp[2] - half2 * force.weft[2];
  }
}

template <Formulation formulation, Thickness thickness_kind, class Shear>
void loose_cells(const void* shear_pointer, const LooseCellView& cells, double thickness, const double* const (&x)[3],
                 double* const (&warp_force)[3], double* const (&weft_force)[3]) {
  constexpr int width = LooseCells::width;
  const Shear shear = *static_cast<const Shear*>(shear_pointer);
  const double *px = x[0], *py = x[1], *pz = x[2];
  double *wx = warp_force[0], *wy = warp_force[1], *wz = warp_force[2];
  double *fx = weft_force[0], *fy = weft_force[1], *fz = weft_force[2];
  const int* nodes = cells.node;
  const double *warp = cells.warp, *weft = cells.weft, *area = cells.area;
#pragma omp simd
  for (int c = 0; c < cells.count; ++c) {
    double g1[3] = {0.0, 0.0, 0.0}, g2[3] = {0.0, 0.0, 0.0};
    // relative to the first node, so that a translation leaves the bits alone
    const int first = nodes[c * width];
    const double ox = px[first], oy = py[first], oz = pz[first];
#pragma GCC unroll 8
    for (int a = 1; a < width; ++a) {
      const int n = nodes[c * width + a];
      const double c1 = warp[c * width + a], c2 = weft[c * width + a];
      const double rx = px[n] - ox, ry = py[n] - oy, rz = pz[n] - oz;
      g1[0] += c1 * rx;
      g1[1] += c1 * ry;
      g1[2] += c1 * rz;
      g2[0] += c2 * rx;
      g2[1] += c2 * ry;
      g2[2] += c2 * rz;
    }
    const CellForce force = shear_cell_force<formulation, thickness_kind>(shear, g1, g2, area[c] * thickness);
    wx[c] = force.warp[0];
    wy[c] = force.warp[1];
    wz[c] = force.warp[2];
    fx[c] = force.weft[0];
    fy[c] = force.weft[1];
    fz[c] = force.weft[2];
  }
}

template <Formulation formulation, Thickness thickness>
CellKernels shaped_cell_kernels(bool paper) {
  using Paper = KernelShear<PaperShearLaw>;
  using General = KernelShear<GeneralLaw>;
  if (paper) return {&cell_row<formulation, thickness, Paper>, &loose_cells<formulation, thickness, Paper>};
  return {&cell_row<formulation, thickness, General>, &loose_cells<formulation, thickness, General>};
}

template <Section section>
YarnKernels shaped_yarn_kernels(bool paper) {
  if (paper) return {&yarn_row<section, PaperLaw>, &loose_yarns<section, PaperLaw>};
  return {&yarn_row<section, GeneralLaw>, &loose_yarns<section, GeneralLaw>};
}

}  // namespace

YarnKernels yarn_kernels(Section section, bool paper) {
  return section == Section::incompressible ? shaped_yarn_kernels<Section::incompressible>(paper)
                                            : shaped_yarn_kernels<Section::constant>(paper);
}

CellKernels cell_kernels(Formulation formulation, Thickness thickness, bool paper) {
  const bool constant = thickness == Thickness::constant;
  if (formulation == Formulation::energy)
    return constant ? shaped_cell_kernels<Formulation::energy, Thickness::constant>(paper)
                    : shaped_cell_kernels<Formulation::energy, Thickness::constant_volume>(paper);
  return constant ? shaped_cell_kernels<Formulation::contravariant, Thickness::constant>(paper)
                  : shaped_cell_kernels<Formulation::contravariant, Thickness::constant_volume>(paper);
}

void assemble_row(const double* along, const double* across, const double* p, const double* q, double* carry, double* force,
                  int begin, int end) {
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

}  // namespace weaveform
