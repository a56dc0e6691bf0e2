// The inner loops of bending: crossings begin <= i < end of one row, cells of one row, and loose bends one by one.
// Compiled once for each instruction set (core/instructions), each compilation for itself: it must include nothing whose
// inline code other files share.
#pragma once

#include "solver/bending/yarn_bend.hpp"

namespace weaveform {

// Positions of the row at hand and those below and above it.
struct BendRows {
  const double *below[3], *here[3], *above[3];
};

// Force of the bend at crossing i on the node after and before it along the warp (same row, i + 1 and i - 1) and along
// the weft (rows above and below, i); the crossing itself gets the opposite of their sum, `centre`.
struct BendRowOutput {
  double *warp_after[3], *warp_before[3], *weft_after[3], *weft_before[3], *centre[3];
};

// `warp_yarns`, `weft_yarns`: yarns that bend at each crossing; all elements of a family have one rest length, given by
// its inverse.
using BendRow = void (*)(const void* warp_flexure, const void* weft_flexure, const BendRows& rows, double inverse_warp,
                         double inverse_weft, const double* warp_yarns, const double* weft_yarns, int begin, int end,
                         const BendRowOutput& out);

// Bends whose neighbours are anywhere (bends.hpp): node, before and after of both families; what is fixed is given as
// a tangent, with weight 0 for the element's own.
struct LooseBendView {
  int count;
  const int *node, *before[2], *after[2];
  const double *yarns[2], *inverse_spread[2];
  const double *own_before[2], *own_after[2];            // 1, or 0 where the tangent is fixed or there is no element
  const double *fixed_before[2][3], *fixed_after[2][3];  // 0 where the tangent is the element's own
};
// force[f][side][c]: on the node before (side 0) and after (side 1).
using LooseBendLoop = void (*)(const void* warp_flexure, const void* weft_flexure, const LooseBendView& bends,
                               const double* const (&x)[3], double* const (&force)[2][2][3]);

struct BendKernels {
  BendRow row;
  LooseBendLoop loose;
};

// The laws are ConstantFlexure, CurvedFlexure, LongFlexure or SidedFlexure, as `shape` says. `isotropic`: in plane as out
// of plane, in both families and senses.
[[nodiscard]] BendKernels bend_kernels(MomentShape shape, bool isotropic);

// Twist of full cells: w,12 = q.n/(h1 h2) with q = x00 - x10 - x01 + x11 and n the normal of both diagonals;
//   E = 2 D A (q.n)^2/(h1 h2)^2 , D = D_66 per width, A the flat area.
// `stiffness` = 4 D A/(h1 h2)^2 per cell. Forces: on x00 a + d, on x11 a - d, on x01 -a + e, on x10 -a - e.
struct TwistRowOutput {
  double *a[3], *d[3], *e[3];
};
void twist_row(const BendRows& rows, const double* stiffness, int begin, int end, const TwistRowOutput& out);

// f[i] += centre[i] + warp_after[i-1] + warp_before[i+1] + below_weft_after[i] + above_weft_before[i]
void bend_assemble(const double* centre, const double* warp_after, const double* warp_before,
                   const double* below_weft_after, const double* above_weft_before, double* force, int begin, int end);
// f[i] += (a + d)[i] + (-a - e)[i-1] of the cells above, (-a + e)[i] + (a - d)[i-1] of those below
void twist_assemble(const double* a, const double* d, const double* e, const double* below_a, const double* below_d,
                    const double* below_e, double* force, int begin, int end);

// One compilation of the functions above (core/instructions/choose_loops.hpp).
struct BendLoops {
  decltype(&weaveform::bend_kernels) bend_kernels;
  decltype(&weaveform::twist_row) twist_row;
  decltype(&weaveform::bend_assemble) bend_assemble;
  decltype(&weaveform::twist_assemble) twist_assemble;
};

}  // namespace weaveform
