#include "post/dic/virtual/strain_window.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "post/dic/virtual/point_bins.hpp"

namespace weaveform::dic {
namespace {

using Gradient = Eigen::Matrix<double, 3, 2>;

// Columns of F g1, F g2 with F = I (in the plane) + grad u.
Eigen::Matrix<double, 3, 2> yarns_now(const Gradient& gradient, const YarnDirections& yarns) {
  Eigen::Matrix2d g;
  g << yarns.g1[0], yarns.g2[0], yarns.g1[1], yarns.g2[1];
  Gradient f = gradient;
  f(0, 0) += 1.0;
  f(1, 1) += 1.0;
  return f * g;
}

}  // namespace

Neighbours find_neighbours(const std::vector<Vec2>& points, double step, int window) {
  // Half a step beyond the outermost points of a grid, less a little: grids may be stretched or turned slightly.
  const double reach = (0.5 * (window - 1) + 0.4) * step;
  const PointBins bins(points, std::max(step, reach / 2.0));
  Neighbours result;
  result.point.reserve(points.size() * static_cast<std::size_t>(window) * static_cast<std::size_t>(window));
  for (const Vec2& point : points) {
    const auto begin = result.point.size();
    bins.within(point, reach, [&](int j) { result.point.push_back(j); });
    std::sort(result.point.begin() + static_cast<std::ptrdiff_t>(begin), result.point.end());
    result.offset.push_back(static_cast<int>(result.point.size()));
    result.full = std::max(result.full, static_cast<int>(result.point.size() - begin));
  }
  result.full = std::min(result.full, window * window);
  return result;
}

double typical_step(const std::vector<Vec2>& points) {
  const PointBins bins(points, 0.0);
  std::vector<double> nearest;
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 2000);  // a sample does
  for (std::size_t i = 0; i < points.size(); i += stride) {
    double least = HUGE_VAL;
    for (double reach = 2.0 * bins.side(); !(least <= reach) && reach < 1e4 * bins.side(); reach *= 2.0)
      bins.within(points[i], reach, [&](int j) {
        const double distance = std::hypot(points[j][0] - points[i][0], points[j][1] - points[i][1]);
        if (static_cast<std::size_t>(j) != i && distance > 0.0) least = std::min(least, distance);
      });
    if (std::isfinite(least)) nearest.push_back(least);
  }
  if (nearest.empty()) return 0.0;
  std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2), nearest.end());
  return nearest[nearest.size() / 2];
}

WindowFit fit_window(const std::vector<Vec2>& points, const Neighbours& neighbours, std::size_t i,
                     const std::vector<bool>& valid, const std::vector<Vec3>& displacement, double fill) {
  // Everything relative to the middle point, so that no digits are lost in large displacements.
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d right = Eigen::Matrix3d::Zero();  // row: 1, dx, dy; column: u1, u2, u3
  double square = 0.0;
  WindowFit fit;
  const Vec2& centre = points[i];
  const Vec3& here = displacement[i];
  for (int k = neighbours.offset[i]; k < neighbours.offset[i + 1]; ++k) {
    const int j = neighbours.point[k];
    if (!valid[j]) continue;
    const double x = points[j][0] - centre[0], y = points[j][1] - centre[1];
    const Vec3& there = displacement[j];
    const double u = there[0] - here[0], v = there[1] - here[1], w = there[2] - here[2];
    normal(0, 0) += 1.0;
    normal(1, 0) += x;
    normal(2, 0) += y;
    normal(1, 1) += x * x;
    normal(2, 1) += x * y;
    normal(2, 2) += y * y;
    right(0, 0) += u;
    right(0, 1) += v;
    right(0, 2) += w;
    right(1, 0) += x * u;
    right(1, 1) += x * v;
    right(1, 2) += x * w;
    right(2, 0) += y * u;
    right(2, 1) += y * v;
    right(2, 2) += y * w;
    square += u * u + v * v;
    ++fit.count;
  }
  normal(0, 1) = normal(1, 0);
  normal(0, 2) = normal(2, 0);
  normal(1, 2) = normal(2, 1);
  if (fit.count < 4 || fit.count < fill * neighbours.full || !valid[i]) return fit;
  // Points along one line leave the gradient across it open.
  const double size = normal(1, 1) + normal(2, 2);
  const double flatness = normal(1, 1) * normal(2, 2) - normal(1, 2) * normal(1, 2);
  if (!(flatness > 1e-3 * size * size)) return fit;
  bool invertible = false;
  normal.computeInverseWithCheck(fit.inverse, invertible, 0.0);
  if (!invertible) return fit;
  const Eigen::Matrix3d plane = fit.inverse * right;
  fit.gradient = plane.bottomRows<2>().transpose();
  const double rest = square - (plane.leftCols<2>().cwiseProduct(right.leftCols<2>())).sum();
  if (fit.count > 3) fit.scatter = std::sqrt(std::max(0.0, rest) / (2.0 * (fit.count - 3)));
  fit.good = true;
  return fit;
}

YarnDirections yarn_directions(const BlankSpec& blank) {
  const double angle = blank.yarn_angle * std::numbers::pi / 180.0;
  return {{std::cos(angle), std::sin(angle)}, {-std::sin(angle), std::cos(angle)}};
}

double shear_angle(const Gradient& gradient, const YarnDirections& yarns) {
  const auto f = yarns_now(gradient, yarns);
  return std::asin(std::clamp(f.col(0).dot(f.col(1)) / (f.col(0).norm() * f.col(1).norm()), -1.0, 1.0));
}

Gradient angle_sensitivity(const Gradient& gradient, const YarnDirections& yarns) {
  const auto f = yarns_now(gradient, yarns);
  const double length1 = f.col(0).norm(), length2 = f.col(1).norm();
  const Eigen::Vector3d d1 = f.col(0) / length1, d2 = f.col(1) / length2;
  const double sine = d1.dot(d2), cosine = std::sqrt(std::max(1e-12, 1.0 - sine * sine));
  // d(d1.d2) = (d2 - s d1).d f1 / |f1| + (d1 - s d2).d f2 / |f2|,  d f = (d grad u) g
  const Eigen::Vector3d of1 = (d2 - sine * d1) / (length1 * cosine), of2 = (d1 - sine * d2) / (length2 * cosine);
  return of1 * Eigen::RowVector2d(yarns.g1[0], yarns.g1[1]) + of2 * Eigen::RowVector2d(yarns.g2[0], yarns.g2[1]);
}

double angle_uncertainty(const WindowFit& fit, const Gradient& sensitivity, double uncertainty, int components) {
  // The gradient's rows are independent, each with covariance u^2 times the lower right of the inverse normal matrix.
  const Eigen::Matrix2d covariance = fit.inverse.bottomRightCorner<2, 2>();
  double variance = 0.0;
  for (int k = 0; k < components; ++k)
    variance += (sensitivity.row(k) * covariance * sensitivity.row(k).transpose()).value();
  return uncertainty * std::sqrt(variance);
}

}  // namespace weaveform::dic
