#include "mesher/lattice/outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace weaveform::lattice {

namespace {

// Value at x of F(x) = integral over [low, x] of 1 inside [low, high], and of the same with the integrand x.
struct Clamped {
  double low, high;
  [[nodiscard]] double length(double x) const { return std::clamp(x, low, high) - low; }
  [[nodiscard]] double moment(double x) const {
    const double c = std::clamp(x, low, high);
    return 0.5 * (c - low) * (c + low);
  }
};

// Simpson's rule along one straight piece on which the integrands are at most quadratic, hence exact.
void add_piece(const Clamped& clamp, const Vec2& a, const Vec2& b, Moments& sum) {
  const Vec2 middle = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  const double dv = b[1] - a[1];
  const auto weigh = [&](const Vec2& p, double weight) {
    sum.area += weight * clamp.length(p[0]) * dv;
    sum.first[0] += weight * clamp.moment(p[0]) * dv;
    sum.first[1] += weight * clamp.length(p[0]) * p[1] * dv;
  };
  weigh(a, 1.0 / 6.0);
  weigh(middle, 4.0 / 6.0);
  weigh(b, 1.0 / 6.0);
}

// The share of one edge: its part with v in the box's range, broken where u enters or leaves the box.
void add_edge(const OutlineEdge& edge, const Box& box, Moments& sum) {
  const Vec2& a = edge.from;
  const Vec2& b = edge.to;
  const auto parameter = [&](int axis, double value) { return (value - a[axis]) / (b[axis] - a[axis]); };
  if (a[1] == b[1]) return;  // dv = 0
  double t0 = std::clamp(parameter(1, box.low[1]), 0.0, 1.0);
  double t1 = std::clamp(parameter(1, box.high[1]), 0.0, 1.0);
  if (t0 > t1) std::swap(t0, t1);
  if (t0 == t1) return;
  std::array<double, 4> cut = {t0, t0, t1, t1};
  if (a[0] != b[0]) {
    cut[1] = std::clamp(parameter(0, box.low[0]), t0, t1);
    cut[2] = std::clamp(parameter(0, box.high[0]), t0, t1);
    if (cut[1] > cut[2]) std::swap(cut[1], cut[2]);
  }
  const auto at = [&](double t) { return Vec2{a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}; };
  for (std::size_t k = 0; k < 3; ++k)
    if (cut[k] < cut[k + 1]) add_piece({box.low[0], box.high[0]}, at(cut[k]), at(cut[k + 1]), sum);
}

// Crossings of the line with the edges, sorted and paired. The half-open rule counts a vertex once.
std::vector<Span> chords_at(const Outline& outline, int axis, double across) {
  std::vector<double> hit;
  for (const auto& edge : outline.edge) {
    const double a = edge.from[1 - axis];
    const double b = edge.to[1 - axis];
    if ((a <= across) == (b <= across)) continue;
    hit.push_back(edge.from[axis] + (across - a) / (b - a) * (edge.to[axis] - edge.from[axis]));
  }
  std::sort(hit.begin(), hit.end());
  std::vector<Span> inside;
  for (std::size_t k = 0; k + 1 < hit.size(); k += 2) inside.push_back({hit[k], hit[k + 1]});
  return inside;
}

double total_length(const std::vector<Span>& intervals) {
  double sum = 0.0;
  for (const auto& i : intervals) sum += i.to - i.from;
  return sum;
}

}  // namespace

Turn turn_by_degrees(double degrees) {
  // Reduced to [-45, 45] degrees plus quarter turns, which are exact.
  const double quarters = std::round(degrees / 90.0);
  const double rest = degrees - 90.0 * quarters;
  const double angle = rest * std::numbers::pi / 180.0;
  Turn turn{std::cos(angle), std::sin(angle)};
  if (std::abs(rest) == 45.0) turn = {std::sqrt(0.5), std::copysign(std::sqrt(0.5), rest)};
  const int count = static_cast<int>(std::fmod(std::fmod(quarters, 4.0) + 4.0, 4.0));
  for (int k = 0; k < count; ++k) turn = {-turn.sine, turn.cosine};
  return turn;
}

Outline rectangle_outline(const Vec2& size, const Turn& yarns) {
  const double x = 0.5 * size[0];
  const double y = 0.5 * size[1];
  const std::array<Vec2, 4> corner = {yarns.back({-x, -y}), yarns.back({x, -y}), yarns.back({x, y}),
                                      yarns.back({-x, y})};
  return {{{corner[0], corner[1], BlankEdge::bottom},
           {corner[1], corner[2], BlankEdge::right},
           {corner[2], corner[3], BlankEdge::top},
           {corner[3], corner[0], BlankEdge::left}}};
}

Box bounding_box(const Outline& outline) {
  Box box{outline.edge.front().from, outline.edge.front().from};
  for (const auto& edge : outline.edge) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      box.low[axis] = std::min(box.low[axis], edge.from[axis]);
      box.high[axis] = std::max(box.high[axis], edge.from[axis]);
    }
  }
  return box;
}

// Green's theorem with F(u) = clamp(u, u0, u1) - u0, whose derivative is 1 inside the box and 0 outside:
//   area = closed integral of F(u) dv over the boundary with v in [v0, v1].
// Edge by edge, so holes and concave parts need no clipping, and neighbouring boxes share out the area without a gap.
Moments moments_in_box(const Outline& outline, const Box& box) {
  // Measured from the box's lower corner, where the rounding of the moments is least.
  const Vec2 origin = box.low;
  const Box local{{0.0, 0.0}, {box.high[0] - origin[0], box.high[1] - origin[1]}};
  Moments sum;
  for (const auto& edge : outline.edge) {
    const OutlineEdge moved{
        {edge.from[0] - origin[0], edge.from[1] - origin[1]}, {edge.to[0] - origin[0], edge.to[1] - origin[1]}, {}};
    add_edge(moved, local, sum);
  }
  for (std::size_t axis = 0; axis < 2; ++axis) sum.first[axis] += sum.area * origin[axis];
  return sum;
}

std::vector<Span> chords(const Outline& outline, int axis, double across, double tolerance) {
  std::vector<Span> inside = chords_at(outline, axis, across);
  // A line along an edge is in or out by its last bit: a step to either side tells whether the blank lies there.
  // The length then jumps; on a line that cuts the outline obliquely it changes by about the step only.
  double length = total_length(inside);
  for (const double step : {-tolerance, tolerance}) {
    std::vector<Span> beside = chords_at(outline, axis, across + step);
    if (total_length(beside) > length + 1e5 * tolerance) {
      length = total_length(beside);
      inside = std::move(beside);
    }
  }
  return inside;
}

double distance_to_edge(const OutlineEdge& edge, const Vec2& point) {
  const Vec2 along = minus(edge.to, edge.from), away = minus(point, edge.from);
  const double t = std::clamp(dot(away, along) / dot(along, along), 0.0, 1.0);
  return distance(away, scaled(along, t));
}

}  // namespace weaveform::lattice
