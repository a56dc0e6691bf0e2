// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/contact/edge_kernel.hpp"

#define WEAVEFORM_INLINE [[gnu::always_inline]] inline

namespace weaveform::WEAVEFORM_SET {
namespace {

constexpr double least = 1e-30;  // mm^4; far below anything that matters

struct Line {
  double weight[3], slope[3];
};

// Weights that have come to nothing are 0: there may be no crossing there.
WEAVEFORM_INLINE Line line_at(double u, double given) {
  const double b = given > 0.0 ? given : 1.0;
  const double low = u > -b ? u : -b, inside = low < b ? low : b;
  const double far_before = -b - u > 0.0 ? -b - u : 0.0, far_after = u - b > 0.0 ? u - b : 0.0;
  const double inverse = 0.5 / b, to_end = b - inside, from_end = b + inside;
  const double round_before = 0.5 * to_end * to_end * inverse + far_before,
               round_after = 0.5 * from_end * from_end * inverse + far_after;
  const double round_down = -to_end * inverse, round_up = from_end * inverse;
  const double chord_before = given < 0.0 ? -u : 0.0, chord_after = given < 0.0 ? 0.0 : u;
  const double chord_down = given < 0.0 ? -1.0 : 0.0, chord_up = given < 0.0 ? 0.0 : 1.0;
  const double before = given > 0.0 ? round_before : chord_before, after = given > 0.0 ? round_after : chord_after;
  const double down = given > 0.0 ? round_down : chord_down, up = given > 0.0 ? round_up : chord_up;
  return {{before, 1.0 - before - after, after}, {down, -down - up, up}};
}

struct Surface {
  double s1[3], s2[3], r[3];
};

WEAVEFORM_INLINE Surface surface_at(const EdgeFeet& feet, const Line& u, const Line& v, int i) {
  Surface out;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    double s = 0.0, s1 = 0.0, s2 = 0.0;
#pragma GCC unroll 3
    for (int row = 0; row < 3; ++row) {
      const double x0 = feet.crossing[c][3 * row][i], x1 = feet.crossing[c][3 * row + 1][i],
                   x2 = feet.crossing[c][3 * row + 2][i];
      const double along = u.weight[0] * x0 + u.weight[1] * x1 + u.weight[2] * x2;
      s += v.weight[row] * along;
      s1 += v.weight[row] * (u.slope[0] * x0 + u.slope[1] * x1 + u.slope[2] * x2);
      s2 += v.slope[row] * along;
    }
    out.s1[c] = s1;
    out.s2[c] = s2;
    out.r[c] = feet.x[c][i] - s;
  }
  return out;
}

// r = du S_u + dv S_v + s n, by Cramer's rule.
WEAVEFORM_INLINE void step_on(EdgeFeet& feet, int i) {
  const double u = feet.place[0][i], v = feet.place[1][i];
  const Surface at = surface_at(feet, line_at(u, feet.border[0][i]), line_at(v, feet.border[1][i]), i);
  const double n[3] = {feet.n[0][i], feet.n[1][i], feet.n[2][i]};
  const double a[3] = {at.s2[1] * n[2] - at.s2[2] * n[1], at.s2[2] * n[0] - at.s2[0] * n[2],
                       at.s2[0] * n[1] - at.s2[1] * n[0]};
  const double b[3] = {n[1] * at.s1[2] - n[2] * at.s1[1], n[2] * at.s1[0] - n[0] * at.s1[2],
                       n[0] * at.s1[1] - n[1] * at.s1[0]};
  const double determinant = at.s1[0] * a[0] + at.s1[1] * a[1] + at.s1[2] * a[2];
  const double held = determinant > least ? determinant : 1.0;
  const double inverse = determinant > least ? 1.0 / held : 0.0;
  feet.place[0][i] = u + (at.r[0] * a[0] + at.r[1] * a[1] + at.r[2] * a[2]) * inverse;
  feet.place[1][i] = v + (at.r[0] * b[0] + at.r[1] * b[1] + at.r[2] * b[2]) * inverse;
}

WEAVEFORM_INLINE void look_at(EdgeFeet& feet, int i) {
  const Line u = line_at(feet.place[0][i], feet.border[0][i]), v = line_at(feet.place[1][i], feet.border[1][i]);
  const Surface at = surface_at(feet, u, v, i);
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    feet.s1[c][i] = at.s1[c];
    feet.s2[c][i] = at.s2[c];
    feet.r[c][i] = at.r[c];
    feet.weight[0][c][i] = u.weight[c];
    feet.weight[1][c][i] = v.weight[c];
  }
}

void find(int count, int steps, EdgeFeet& feet) {
  for (int step = 0; step < steps; ++step) {
#pragma omp simd
    for (int i = 0; i < count; ++i) step_on(feet, i);
  }
#pragma omp simd
  for (int i = 0; i < count; ++i) look_at(feet, i);
}

}  // namespace

extern const EdgeLoops edge_loops;
const EdgeLoops edge_loops = {.find = find};

}  // namespace weaveform::WEAVEFORM_SET
