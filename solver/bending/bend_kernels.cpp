#include "solver/bending/bend_kernels.hpp"

#include "solver/bending/bend_geometry.hpp"
#include "solver/bending/loose_bend.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

template <bool isotropic, class Flexure>
void bend_row(const void* warp_flexure, const void* weft_flexure, const BendRows& row_pointers, double inverse_warp,
              double inverse_weft, const double* warp_yarns, const double* weft_yarns, int begin, int end,
              const BendRowOutput& output) {
  const Flexure warp = *static_cast<const Flexure*>(warp_flexure), weft = *static_cast<const Flexure*>(weft_flexure);
  const BendRows rows = row_pointers;
  const BendRowOutput out = output;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    double e1p[3], e1m[3], e2p[3], e2m[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const double x = rows.here[c][i];
      e1p[c] = rows.here[c][i + 1] - x;
      e1m[c] = x - rows.here[c][i - 1];
      e2p[c] = rows.above[c][i] - x;
      e2m[c] = x - rows.below[c][i];
    }
    const BendTangent t1p = bend_tangent(e1p[0], e1p[1], e1p[2]), t1m = bend_tangent(e1m[0], e1m[1], e1m[2]);
    const BendTangent t2p = bend_tangent(e2p[0], e2p[1], e2p[2]), t2m = bend_tangent(e2m[0], e2m[1], e2m[2]);
    double d1[3], d2[3], h[3] = {0.0, 0.0, 0.0}, g1[3], g2[3];
    BendNormal n{};
    if constexpr (!isotropic) {
#pragma GCC unroll 3
      for (int c = 0; c < 3; ++c) {
        d1[c] = e1p[c] + e1m[c];
        d2[c] = e2p[c] + e2m[c];
      }
      n = bend_normal(d1, d2);
    }
    yarn_bend<isotropic>(warp, t1m.t, t1p.t, n.n, warp_yarns[i], inverse_warp, g1, h);
    yarn_bend<isotropic>(weft, t2m.t, t2p.t, n.n, weft_yarns[i], inverse_weft, g2, h);
    double f1p[3], f1m[3], f2p[3], f2m[3];
    bend_force(g1, t1p.t, t1p.inverse_length, f1p);
    bend_force(g1, t1m.t, t1m.inverse_length, f1m);
    bend_force(g2, t2p.t, t2p.inverse_length, f2p);
    bend_force(g2, t2m.t, t2m.inverse_length, f2m);
    double on1[3] = {0.0, 0.0, 0.0}, on2[3] = {0.0, 0.0, 0.0};
    if constexpr (!isotropic) normal_forces(n, h, d1, d2, on1, on2);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      out.centre[c][i] = -(f1p[c] + f1m[c] + f2p[c] + f2m[c]);
      out.warp_after[c][i] = f1p[c] + on1[c];
      out.warp_before[c][i] = f1m[c] - on1[c];
      out.weft_after[c][i] = f2p[c] + on2[c];
      out.weft_before[c][i] = f2m[c] - on2[c];
    }
  }
}

template <bool isotropic, class Flexure>
void loose_bends(const void* warp_flexure, const void* weft_flexure, const LooseBendView& view,
                 const double* const (&positions)[3], double* const (&force)[2][2][3]) {
  const Flexure warp = *static_cast<const Flexure*>(warp_flexure), weft = *static_cast<const Flexure*>(weft_flexure);
  const LooseBendView bends = view;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  double* out[2][2][3];
  for (int f = 0; f < 2; ++f)
    for (int side = 0; side < 2; ++side)
      for (int c = 0; c < 3; ++c) out[f][side][c] = force[f][side][c];
#pragma omp simd
  for (int e = 0; e < bends.count; ++e) {
    const LooseYarn y1 = loose_yarn(bends, x, 0, e), y2 = loose_yarn(bends, x, 1, e);
    double h[3] = {0.0, 0.0, 0.0}, g1[3], g2[3], on1[3] = {0.0, 0.0, 0.0}, on2[3] = {0.0, 0.0, 0.0};
    BendNormal n{};
    if constexpr (!isotropic) n = bend_normal(y1.span, y2.span);
    yarn_bend<isotropic>(warp, y1.before, y1.after, n.n, bends.yarns[0][e], bends.inverse_spread[0][e], g1, h);
    yarn_bend<isotropic>(weft, y2.before, y2.after, n.n, bends.yarns[1][e], bends.inverse_spread[1][e], g2, h);
    if constexpr (!isotropic) normal_forces(n, h, y1.span, y2.span, on1, on2);
    double f1m[3], f1p[3], f2m[3], f2p[3];
    bend_force(g1, y1.before, y1.scale_before, f1m);
    bend_force(g1, y1.after, y1.scale_after, f1p);
    bend_force(g2, y2.before, y2.scale_before, f2m);
    bend_force(g2, y2.after, y2.scale_after, f2p);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      out[0][0][c][e] = f1m[c] - on1[c];
      out[0][1][c][e] = f1p[c] + on1[c];
      out[1][0][c][e] = f2m[c] - on2[c];
      out[1][1][c][e] = f2p[c] + on2[c];
    }
  }
}

template <class Flexure>
BendKernels shaped_kernels(bool isotropic) {
  if (isotropic) return {&bend_row<true, Flexure>, &loose_bends<true, Flexure>};
  return {&bend_row<false, Flexure>, &loose_bends<false, Flexure>};
}

BendKernels bend_kernels(MomentShape shape, bool isotropic) {
  switch (shape) {
    case MomentShape::constant:
      return shaped_kernels<ConstantFlexure>(isotropic);
    case MomentShape::short_law:
      return shaped_kernels<CurvedFlexure>(isotropic);
    case MomentShape::long_law:
      return shaped_kernels<LongFlexure>(isotropic);
    case MomentShape::sided_law:
      break;
  }
  return {&bend_row<false, SidedFlexure>, &loose_bends<false, SidedFlexure>};
}

void twist_row(const BendRows& row_pointers, const double* stiffness, int begin, int end,
               const TwistRowOutput& output) {
  const BendRows rows = row_pointers;
  const TwistRowOutput out = output;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    double q[3], d[3], e[3], g[3], on_d[3], on_e[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const double x00 = rows.here[c][i], x10 = rows.here[c][i + 1], x01 = rows.above[c][i], x11 = rows.above[c][i + 1];
      d[c] = x11 - x00;
      e[c] = x01 - x10;
      q[c] = (x00 - x10) - (x01 - x11);
    }
    const BendNormal n = bend_normal(d, e);
    const double force = stiffness[i] * (q[0] * n.n[0] + q[1] * n.n[1] + q[2] * n.n[2]);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) g[c] = force * q[c];  // dE/dn
    normal_forces(n, g, d, e, on_d, on_e);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      out.a[c][i] = -force * n.n[c];
      out.d[c][i] = -on_d[c];
      out.e[c][i] = on_e[c];
    }
  }
}

void bend_assemble(const double* centre, const double* warp_after, const double* warp_before,
                   const double* below_weft_after, const double* above_weft_before, double* force, int begin, int end) {
#pragma omp simd
  for (int i = begin; i < end; ++i)
    force[i] += centre[i] + warp_after[i - 1] + warp_before[i + 1] + below_weft_after[i] + above_weft_before[i];
}

void twist_assemble(const double* a, const double* d, const double* e, const double* below_a, const double* below_d,
                    const double* below_e, double* force, int begin, int end) {
#pragma omp simd
  for (int i = begin; i < end; ++i)
    force[i] += (a[i] + d[i]) - (a[i - 1] + e[i - 1]) + (below_e[i] - below_a[i]) + (below_a[i - 1] - below_d[i - 1]);
}

}  // namespace

extern const BendLoops bend_loops;
const BendLoops bend_loops = {.bend_kernels = bend_kernels,
                              .twist_row = twist_row,
                              .bend_assemble = bend_assemble,
                              .twist_assemble = twist_assemble};

}  // namespace weaveform::WEAVEFORM_SET
