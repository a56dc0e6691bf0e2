#include "mesher/outline/dxf_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

constexpr int most_pieces = 1 << 14;  // of one arc or span of a spline

// The chord over an angle a of radius r leaves the arc by r (1 - cos(a/2)). Along an ellipse the greater half axis
// bounds it, for it is a circle of that radius pressed flat.
int chords_over(double radius, double angle, double tolerance) {
  if (!(radius > tolerance)) return 4;
  const double each = 2.0 * std::acos(1.0 - tolerance / radius);
  return static_cast<int>(std::clamp(std::ceil(std::abs(angle) / each), 1.0, static_cast<double>(most_pieces)));
}

// Chords of one span are halved until its own points lie within the tolerance of their middles.
void add_span(const Spline& spline, double from, double to, double tolerance, std::vector<DrawnPoint>& line) {
  for (int chords = 4; chords <= most_pieces; chords *= 2) {
    std::vector<DrawnPoint> finer;
    for (int k = 0; k <= 2 * chords; ++k) finer.push_back(point_on(spline, from + (to - from) * k / (2 * chords)));
    double worst = 0.0;
    for (int k = 0; k < 2 * chords; k += 2)
      worst = std::max(
          worst, distance(DrawnPoint{0.5 * (finer[k][0] + finer[k + 2][0]), 0.5 * (finer[k][1] + finer[k + 2][1])},
                          finer[k + 1]));
    if (worst > tolerance && chords < most_pieces) continue;
    for (int k = 2; k <= 2 * chords; k += 2) line.push_back(finer[k]);
    return;
  }
}

}  // namespace

std::vector<DrawnPoint> elliptic_arc(const DrawnPoint& centre, const DrawnPoint& first_axis,
                                     const DrawnPoint& second_axis, double from, double sweep, double tolerance) {
  const double radius = std::max(length(first_axis), length(second_axis));
  const bool whole = std::abs(std::abs(sweep) - 2.0 * std::numbers::pi) < 1e-12;
  const int chords = std::max(whole ? 8 : 1, chords_over(radius, sweep, tolerance));
  std::vector<DrawnPoint> line;
  for (int k = 0; k <= chords; ++k) {
    const double t = from + sweep * k / chords;
    line.push_back({centre[0] + std::cos(t) * first_axis[0] + std::sin(t) * second_axis[0],
                    centre[1] + std::cos(t) * first_axis[1] + std::sin(t) * second_axis[1]});
  }
  if (whole) line.back() = line.front();
  return line;
}

// With the chord's middle M and half its length h, the centre lies at M + n h (1 - b^2) / (2 b) on the left n of the
// way.
std::vector<DrawnPoint> bulge_arc(const DrawnPoint& from, const DrawnPoint& to, double bulge, double tolerance) {
  const double chord = distance(from, to);
  if (bulge == 0.0 || chord == 0.0) return {to};
  const double angle = 4.0 * std::atan(bulge);
  const double away = (1.0 - bulge * bulge) / (4.0 * bulge);  // in chords
  const DrawnPoint centre = {0.5 * (from[0] + to[0]) - away * (to[1] - from[1]),
                             0.5 * (from[1] + to[1]) + away * (to[0] - from[0])};
  const DrawnPoint first = {from[0] - centre[0], from[1] - centre[1]};
  std::vector<DrawnPoint> line = elliptic_arc(centre, first, {-first[1], first[0]}, 0.0, angle, tolerance);
  line.erase(line.begin());
  line.back() = to;
  return line;
}

DrawnPoint point_on(const Spline& spline, double parameter) {
  const auto p = static_cast<std::size_t>(spline.degree);
  const std::size_t n = spline.control.size();
  // the span [u_k, u_k+1) that holds the parameter, the last one closed
  std::size_t k = p;
  while (k + 1 < n && parameter >= spline.knot[k + 1]) ++k;
  std::vector<std::array<double, 3>> d(p + 1);
  for (std::size_t j = 0; j <= p; ++j) {
    const std::size_t c = k - p + j;
    const double w = spline.weight[c];
    d[j] = {w * spline.control[c][0], w * spline.control[c][1], w};
  }
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = spline.knot[k - p + j], high = spline.knot[k + 1 + j - r];
      const double a = high > low ? (parameter - low) / (high - low) : 0.0;
      for (std::size_t c = 0; c < 3; ++c) d[j][c] = (1.0 - a) * d[j - 1][c] + a * d[j][c];
    }
  return {d[p][0] / d[p][2], d[p][1] / d[p][2]};
}

std::vector<DrawnPoint> spline_chords(const Spline& spline, double tolerance) {
  const auto p = static_cast<std::size_t>(spline.degree);
  std::vector<DrawnPoint> line = {point_on(spline, spline.knot[p])};
  for (std::size_t k = p; k < spline.control.size(); ++k)
    if (spline.knot[k + 1] > spline.knot[k]) add_span(spline, spline.knot[k], spline.knot[k + 1], tolerance, line);
  return line;
}

}  // namespace weaveform
