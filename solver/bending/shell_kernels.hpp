// The inner loops of shell cells: edges and cells of one row, loose edges, and the motion of the directors. Compiled
// once for each instruction set (core/instructions), each compilation for itself: it must include nothing whose inline
// code other files share.
#pragma once

#include "solver/bending/shell_edge.hpp"

namespace weaveform {

// Positions and directors at the first and second node of each edge, or of the lower and upper row of each cell.
struct ShellRows {
  const double *xa[3], *xb[3];
  const double *da[3], *db[3];
};

// force: on xb (the opposite on xa); bend, shear: on da bend - shear, on db -bend - shear.
struct EdgeOutput {
  double *force[3], *bend[3], *shear[3];
};
// `yarns` per edge; `shear_per_yarn` = G interval L (N mm).
using EdgeRow = void (*)(const void* moment, const ShellRows& rows, double inverse_rest, const double* yarns,
                         double shear_per_yarn, int begin, int end, const EdgeOutput& out);

struct LooseEdgeView {
  int count;
  const int *node0, *node1;
  const double *yarns, *inverse_rest, *shear_stiffness;
};
using LooseEdgeLoop = void (*)(const void* moment, const LooseEdgeView& edges, const double* const (&x)[3],
                               const double* const (&d)[3], const EdgeOutput& out);

struct EdgeKernels {
  EdgeRow row;
  LooseEdgeLoop loose;
};
// The law is a ConstantMoment, CurvedMoment, LongMoment or SidedMoment, as `shape` says.
[[nodiscard]] EdgeKernels edge_kernels(MomentShape shape);

// Twist of the cells with corners a[i], a[i+1], b[i], b[i+1]; `stiffness` = D_66 A (N mm^3). On a[i] p, on b[i+1] -p,
// on b[i] q, on a[i+1] -q, for positions (xp, xq) and directors (dp, dq).
struct ShellTwistOutput {
  double *xp[3], *xq[3], *dp[3], *dq[3];
};
void shell_twist_row(const ShellRows& rows, double inverse_spacing1, double inverse_spacing2, const double* stiffness,
                     int begin, int end, const ShellTwistOutput& out);

// What the elements of a row and of the row below it give to the row's nodes, added to `force`:
//   on positions  along[i-1] - along[i] + across_below[i] - across[i] + p[i] - q[i-1] + q_below[i] - p_below[i-1]
void shell_position_assemble(const double* along, const double* across, const double* across_below, const double* p,
                             const double* q, const double* p_below, const double* q_below, double* force, int begin,
                             int end);
//   on directors, set: (bend - shear)[i] - (bend + shear)[i-1] of both kinds, and p, q as above
struct DirectorRow {
  const double *along_bend, *along_shear, *across_bend, *across_shear, *below_bend, *below_shear;
  const double *p, *q, *p_below, *q_below;
};
void shell_director_assemble(const DirectorRow& row, double* force, int begin, int end);

// Directors d with velocities v (perpendicular to d) over a time: along the great circle,
//   d+ = d cos(theta) + v/|v| sin(theta) ,  v+ = v cos(theta) - d |v| sin(theta) ,  theta = |v| time
void drift_directors(double* const (&d)[3], double* const (&v)[3], double time, int begin, int end);
// v+ = keep v + kick (f - (f.d) d)/J ; returns the sum of J v0^2 with v0 = (v + v+)/2 in eight fixed lanes.
void kick_directors(const double* const (&d)[3], double* const (&v)[3], const double* const (&force)[3],
                    const double* inertia, const double* inverse_inertia, double keep, double kick, int begin, int end,
                    double* sums);

// One compilation of the functions above (core/instructions/choose_loops.hpp).
struct ShellLoops {
  decltype(&weaveform::edge_kernels) edge_kernels;
  decltype(&weaveform::shell_twist_row) shell_twist_row;
  decltype(&weaveform::shell_position_assemble) shell_position_assemble;
  decltype(&weaveform::shell_director_assemble) shell_director_assemble;
  decltype(&weaveform::drift_directors) drift_directors;
  decltype(&weaveform::kick_directors) kick_directors;
};

}  // namespace weaveform
