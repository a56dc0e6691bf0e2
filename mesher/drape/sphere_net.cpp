#include "mesher/drape/sphere_net.hpp"

#include <cmath>
#include <numbers>

namespace weaveform {
namespace {

struct Net {
  double angle, slope;
};

// By the series n^2 c_n = [s^(n-1)] cos g close to 0, where the equation is singular, then by classical Runge-Kutta.
Net net_at(double s) {
  constexpr double start = 0.02, longest_step = 2e-3;  // next term of the series below 1e-15
  const auto series = [](double x) {
    const double q = x * x;  // c1 = 1, c3 = -1/18, c5 = (1/24 + 1/18)/25 = 7/1800
    return Net{x * (1.0 + q * (-1.0 / 18.0 + q * 7.0 / 1800.0)), 1.0 + q * (-1.0 / 6.0 + q * 7.0 / 360.0)};
  };
  if (s <= start) return series(s);
  Net y = series(start);
  const int steps = static_cast<int>(std::ceil((s - start) / longest_step));
  const double h = (s - start) / steps;
  const auto rate = [](double at, const Net& n) { return Net{n.slope, (std::cos(n.angle) - n.slope) / at}; };
  const auto moved = [](const Net& n, const Net& by, double f) {
    return Net{n.angle + f * by.angle, n.slope + f * by.slope};
  };
  for (int k = 0; k < steps; ++k) {
    const double at = start + k * h;
    const Net k1 = rate(at, y), k2 = rate(at + 0.5 * h, moved(y, k1, 0.5 * h)),
              k3 = rate(at + 0.5 * h, moved(y, k2, 0.5 * h)), k4 = rate(at + h, moved(y, k3, h));
    y.angle += h / 6.0 * (k1.angle + 2.0 * k2.angle + 2.0 * k3.angle + k4.angle);
    y.slope += h / 6.0 * (k1.slope + 2.0 * k2.slope + 2.0 * k3.slope + k4.slope);
  }
  return y;
}

}  // namespace

double sphere_net_angle(double s) {
  return std::copysign(net_at(std::abs(s)).angle, s);
}

double sphere_net_slope(double s) {
  return net_at(std::abs(s)).slope;
}

double sphere_net_end() {
  double s = 1.8;
  for (int n = 0; n < 8; ++n) {  // Newton
    const Net y = net_at(s);
    s += (0.5 * std::numbers::pi - y.angle) / y.slope;
  }
  return s;
}

}  // namespace weaveform
