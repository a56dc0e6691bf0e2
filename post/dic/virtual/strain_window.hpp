// The strain window: around each point, the least-squares plane through the displacements of the points in a square
// window gives the deformation gradient, and with the yarn directions g1, g2 of the flat fabric the shear angle
//   F = I + grad u,   gamma = pi/2 - angle(F g1, F g2) = asin(f1.f2),  f = F g / |F g|.
// Out-of-plane displacements turn and stretch the yarns too: F is 3 x 2. The same code sees the measured and the
// simulated displacements.
#pragma once

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "post/dic/virtual/flat_mesh.hpp"

namespace weaveform::dic {

// The points within each point's window, itself among them.
struct Neighbours {
  std::vector<int> offset = {0};
  std::vector<int> point;
  int full = 0;  // points of a window that lies wholly in the field: the greatest number there is
};

// Windows are squares of `window` points at `step` (mm) from each other, their sides along x and y.
[[nodiscard]] Neighbours find_neighbours(const std::vector<Vec2>& points, double step, int window);

// Median distance of a point from its nearest one: the step of a grid (with points missing here and there).
[[nodiscard]] double typical_step(const std::vector<Vec2>& points);

// A row of the least squares: gradient = sum_j (a + b_x dx_j + b_y dy_j) u_j over the valid points j of the window.
struct WindowFit {
  bool good = false;
  int count = 0;                         // valid points in the window
  Eigen::Matrix3d inverse;               // of the normal matrix of (1, dx, dy)
  Eigen::Matrix<double, 3, 2> gradient;  // of u along x and y
  double scatter = 0.0;                  // mm; standard deviation of u1, u2 about the plane
};

// The fit around point i. `valid` says which points count; the window must hold `fill` of a full one's points.
[[nodiscard]] WindowFit fit_window(const std::vector<Vec2>& points, const Neighbours& neighbours, std::size_t i,
                                   const std::vector<bool>& valid, const std::vector<Vec3>& displacement, double fill);

// Yarn directions on the flat fabric, blank frame.
struct YarnDirections {
  Vec2 g1, g2;
};
[[nodiscard]] YarnDirections yarn_directions(const BlankSpec& blank);

[[nodiscard]] double shear_angle(const Eigen::Matrix<double, 3, 2>& gradient, const YarnDirections& yarns);  // rad

// d gamma / d grad u, so that for small changes d gamma = sum_kl sensitivity(k, l) d(grad u)(k, l).
[[nodiscard]] Eigen::Matrix<double, 3, 2> angle_sensitivity(const Eigen::Matrix<double, 3, 2>& gradient,
                                                            const YarnDirections& yarns);

// Standard uncertainty of the angle (rad) when every displacement component of the window scatters independently with
// standard deviation `uncertainty` (mm); `components` = 2 when w was not measured.
[[nodiscard]] double angle_uncertainty(const WindowFit& fit, const Eigen::Matrix<double, 3, 2>& sensitivity,
                                       double uncertainty, int components);

}  // namespace weaveform::dic
