#include "tests/support/elastica.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weaveform::test {
namespace {

using Y = std::array<double, 4>;  // angle, moment, x, drop

Y slope(const Rod& rod, double s, const Y& y) {
  const double c = std::cos(y[0]);
  return {rod.curvature(y[1]), -(rod.weight * (rod.length - s) + rod.end_load) * c, c, std::sin(y[0])};
}

Y moved(const Y& y, const Y& k, double by) {
  return {y[0] + by * k[0], y[1] + by * k[1], y[2] + by * k[2], y[3] + by * k[3]};
}

// From the free end, where x and drop are counted from, back to the clamp.
std::vector<Y> integrate(const Rod& rod, double tip_angle, int steps) {
  std::vector<Y> path(steps + 1);
  path[steps] = {tip_angle, 0.0, 0.0, 0.0};
  const double h = -rod.length / steps;
  for (int n = steps; n > 0; --n) {
    const double s = rod.length * n / steps;
    const Y& y = path[n];
    const Y k1 = slope(rod, s, y), k2 = slope(rod, s + 0.5 * h, moved(y, k1, 0.5 * h)),
            k3 = slope(rod, s + 0.5 * h, moved(y, k2, 0.5 * h)), k4 = slope(rod, s + h, moved(y, k3, h));
    for (std::size_t c = 0; c < 4; ++c) path[n - 1][c] = y[c] + h / 6.0 * (k1[c] + 2.0 * k2[c] + 2.0 * k3[c] + k4[c]);
  }
  return path;
}

double at(const std::vector<double>& values, double length, double s) {
  const double place = std::clamp(s / length, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto n = std::min(static_cast<std::size_t>(place), values.size() - 2);
  const double part = place - static_cast<double>(n);
  return (1.0 - part) * values[n] + part * values[n + 1];
}

}  // namespace

double RodShape::angle_at(double s) const {
  return at(angle, length, s);
}

double RodShape::x_at(double s) const {
  return at(x, length, s);
}

double RodShape::drop_at(double s) const {
  return at(drop, length, s);
}

RodShape solve_rod(const Rod& rod, int steps) {
  double low = 0.0, high = 0.5 * std::numbers::pi;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (integrate(rod, middle, steps).front()[0] < 0.0 ? low : high) = middle;
  }
  const auto path = integrate(rod, 0.5 * (low + high), steps);
  RodShape shape;
  shape.length = rod.length;
  for (const auto& y : path) {
    shape.angle.push_back(y[0]);
    shape.x.push_back(y[2] - path.front()[2]);
    shape.drop.push_back(y[3] - path.front()[3]);
  }
  return shape;
}

}  // namespace weaveform::test
