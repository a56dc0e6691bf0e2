#include "mesher/lattice/expected_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/outline/loops.hpp"

namespace weaveform {
namespace {

constexpr double outlying = 5.0;  // the box's area with the corner over that without it

struct OutlineBox {
  std::array<double, 2> low = {HUGE_VAL, HUGE_VAL}, high = {-HUGE_VAL, -HUGE_VAL};
  void take_in(const std::array<double, 2>& p) {
    for (std::size_t c = 0; c < 2; ++c) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  }
  [[nodiscard]] std::array<double, 2> extent() const { return {high[0] - low[0], high[1] - low[1]}; }
  [[nodiscard]] double area() const { return extent()[0] * extent()[1]; }
};

// Only a corner that alone reaches a side of the box can be one: there are four candidates at most.
std::string find_outlier(const std::vector<OutlineLoop>& loops, const OutlineBox& box) {
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.point.size(); ++k) {
      const auto& p = loop.point[k];
      if (p[0] != box.low[0] && p[0] != box.high[0] && p[1] != box.low[1] && p[1] != box.high[1]) continue;
      OutlineBox without;
      for (const auto& other : loops)
        for (std::size_t n = 0; n < other.point.size(); ++n)
          if (&other != &loop || n != k) without.take_in(other.point[n]);
      // three corners have no majority
      if (loop.point.size() < 4 || !(without.area() * outlying < box.area())) continue;
      return fmt::format("{} ({:.6g}, {:.6g})", k < loop.place.size() ? loop.place[k] : fmt::format("corner {}", k + 1),
                         p[0], p[1]);
    }
  return "";
}

}  // namespace

ExpectedSize expected_size(const BlankSpec& blank, const Card& card, const BlankOutline& outline) {
  ExpectedSize size;
  size.spacing = {blank.coarsening[1] * card.yarn[1].interval, blank.coarsening[0] * card.yarn[0].interval};
  double area = blank.size[0] * blank.size[1];
  if (blank.shape == BlankShape::disc) area *= 0.25 * std::numbers::pi;
  size.extent = blank.size;
  if (blank.shape == BlankShape::polygon || blank.shape == BlankShape::file) {
    OutlineBox box;
    area = 0.0;
    for (const auto& loop : outline.loops) {
      for (const auto& p : loop.point) box.take_in(p);
      area += signed_area(loop.point);  // holes are clockwise
    }
    size.extent = box.extent();
    size.outlier = find_outlier(outline.loops, box);
  }
  const double angle = std::fmod(blank.yarn_angle, 360.0) * std::numbers::pi / 180.0;  // rad
  const double c = std::abs(std::cos(angle)), s = std::abs(std::sin(angle));
  size.cells = area / (size.spacing[0] * size.spacing[1]);
  size.crossings = ((size.extent[0] * c + size.extent[1] * s) / size.spacing[0] + 1.0) *
                   ((size.extent[0] * s + size.extent[1] * c) / size.spacing[1] + 1.0);
  return size;
}

}  // namespace weaveform
