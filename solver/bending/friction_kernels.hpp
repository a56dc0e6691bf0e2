// The inner loops of friction in bending: at every crossing of a row, and at loose bends one by one, the step of the
// friction (bend_friction.hpp) and then its forces, added to those of the elastic laws; edges of shell cells alike.
// Compiled once for each instruction set (core/instructions), each compilation for itself: it must include nothing whose
// inline code other files share.
#pragma once

#include "solver/bending/bend_friction.hpp"
#include "solver/bending/bend_kernels.hpp"
#include "solver/bending/shell_kernels.hpp"

namespace weaveform {

// Of every bend: shares of the greatest moment and the curvatures they belong to, [family][out of plane, in plane].
struct BendFrictionView {
  double *phi[2][2], *curvature[2][2];
};

// Brings the state to the curvatures of `rows`. `lost` (mJ per bend; N mm of one yarn times `yarns`, over the element's
// length) is set to what this step loses. With `begin_at` the curvatures are only taken note of.
using FrictionRowStep = void (*)(const YarnFriction* friction, const BendRows& rows, double inverse_warp,
                                 double inverse_weft, const double* warp_yarns, const double* weft_yarns, int begin,
                                 int end, bool begin_at, const BendFrictionView& state, double* lost);
using FrictionRowForces = void (*)(const YarnFriction* friction, const BendRows& rows, const double* warp_yarns,
                                   const double* weft_yarns, int begin, int end, const BendFrictionView& state,
                                   const BendRowOutput& out);
using FrictionLooseStep = void (*)(const YarnFriction* friction, const LooseBendView& bends,
                                   const double* const (&x)[3], bool begin_at, const BendFrictionView& state,
                                   double* lost);
using FrictionLooseForces = void (*)(const YarnFriction* friction, const LooseBendView& bends,
                                     const double* const (&x)[3], const BendFrictionView& state,
                                     double* const (&force)[2][2][3]);

// Edges of shell cells: one curvature each. `turn`: t.(d_b - d_a).
using FrictionEdgeRowStep = void (*)(double moment, double rise, const ShellRows& rows, double inverse_rest,
                                     const double* yarns, int begin, int end, bool begin_at, double* phi,
                                     double* curvature, double* lost);
using FrictionEdgeRowForces = void (*)(double moment, const ShellRows& rows, const double* yarns, int begin, int end,
                                       const double* phi, const EdgeOutput& out);
using FrictionLooseEdgeStep = void (*)(double moment, double rise, const LooseEdgeView& edges,
                                       const double* const (&x)[3], const double* const (&d)[3], bool begin_at,
                                       double* phi, double* curvature, double* lost);
using FrictionLooseEdgeForces = void (*)(double moment, const LooseEdgeView& edges, const double* const (&x)[3],
                                         const double* const (&d)[3], const double* phi, const EdgeOutput& out);

// One compilation of them (core/instructions/choose_loops.hpp).
struct FrictionLoops {
  FrictionRowStep row_step;
  FrictionRowForces row_forces;
  FrictionLooseStep loose_step;
  FrictionLooseForces loose_forces;
  FrictionEdgeRowStep edge_row_step;
  FrictionEdgeRowForces edge_row_forces;
  FrictionLooseEdgeStep loose_edge_step;
  FrictionLooseEdgeForces loose_edge_forces;
};

// That of the machine at hand.
[[nodiscard]] const FrictionLoops& friction_loops();

}  // namespace weaveform
