// Tangents and normals at a crossing, for the inner loops of bending. Included by files that are compiled once for each
// instruction set: nothing here but what is always inlined.
#pragma once

#include <cmath>

namespace weaveform {

struct BendTangent {
  double t[3];
  double inverse_length;
};

inline constexpr double least_bend_square = 1e-30;  // mm^2; keeps an absent element's tangent finite

[[gnu::always_inline]] inline BendTangent bend_tangent(double dx, double dy, double dz) {
  const double square = dx * dx + dy * dy + dz * dz;
  const double inverse = 1.0 / std::sqrt(square > least_bend_square ? square : least_bend_square);
  return {{dx * inverse, dy * inverse, dz * inverse}, inverse};
}

struct BendNormal {
  double n[3];
  double inverse_length;
};

[[gnu::always_inline]] inline BendNormal bend_normal(const double (&d1)[3], const double (&d2)[3]) {
  const double x = d1[1] * d2[2] - d1[2] * d2[1], y = d1[2] * d2[0] - d1[0] * d2[2], z = d1[0] * d2[1] - d1[1] * d2[0];
  const double square = x * x + y * y + z * z;
  const double inverse = 1.0 / std::sqrt(square > least_bend_square ? square : least_bend_square);
  return {{x * inverse, y * inverse, z * inverse}, inverse};
}

// With h = dE/dn and N = d1 x d2: dE = w.(dd1 x d2 + d1 x dd2), w = (h - (h.n) n)/|N|; forces on d1 and d2.
[[gnu::always_inline]] inline void normal_forces(const BendNormal& n, const double (&h)[3], const double (&d1)[3],
                                                 const double (&d2)[3], double (&on1)[3], double (&on2)[3]) {
  const double along = h[0] * n.n[0] + h[1] * n.n[1] + h[2] * n.n[2];
  double w[3];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) w[k] = (h[k] - along * n.n[k]) * n.inverse_length;
  on1[0] = w[1] * d2[2] - w[2] * d2[1];
  on1[1] = w[2] * d2[0] - w[0] * d2[2];
  on1[2] = w[0] * d2[1] - w[1] * d2[0];
  on2[0] = d1[1] * w[2] - d1[2] * w[1];
  on2[1] = d1[2] * w[0] - d1[0] * w[2];
  on2[2] = d1[0] * w[1] - d1[1] * w[0];
}

}  // namespace weaveform
