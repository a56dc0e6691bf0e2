// The inextensible rod clamped level at s = 0, by an integration of its own (Runge-Kutta of fourth order, shooting from
// the free end), for comparison with meshes. With theta the angle below the horizontal,
//   theta' = kappa(M) ,  M' = -(w (L - s) + P) cos theta ,  x' = cos theta ,  drop' = sin theta ,  M(L) = 0 .
#pragma once

#include <functional>
#include <vector>

namespace weaveform::test {

struct Rod {
  double length = 0.0;                      // mm
  std::function<double(double)> curvature;  // 1/mm; of a moment (N mm)
  double weight = 0.0;                      // N/mm; per length
  double end_load = 0.0;                    // N; down
};

struct RodShape {
  double length = 0.0;
  std::vector<double> angle, x, drop;  // rad, mm, mm; at equal distances along the rod
  // Interpolated at a place along the rod, for starts.
  [[nodiscard]] double angle_at(double s) const;
  [[nodiscard]] double x_at(double s) const;
  [[nodiscard]] double drop_at(double s) const;
};

// The tip turns by less than 90 degrees. `steps` of 1/4000 of the length leave less than 1e-11 of it.
[[nodiscard]] RodShape solve_rod(const Rod& rod, int steps = 4000);

}  // namespace weaveform::test
