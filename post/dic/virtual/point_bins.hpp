// Scattered points sorted into square bins, for searches within a square.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "post/dic/virtual/flat_mesh.hpp"

namespace weaveform::dic {

// Points sorted into square bins.
class PointBins {
public:
  PointBins(const std::vector<Vec2>& points, double side) : points_(points), side_(side) {
    std::array<double, 2> greatest = {-HUGE_VAL, -HUGE_VAL};
    for (const Vec2& p : points)
      for (std::size_t k = 0; k < 2; ++k) {
        least_[k] = std::min(least_[k], p[k]);
        greatest[k] = std::max(greatest[k], p[k]);
      }
    if (points.empty()) least_ = greatest = {0.0, 0.0};
    // Scattered points far apart must not make more bins than there are points to fill them.
    const double area = (greatest[0] - least_[0]) * (greatest[1] - least_[1]);
    side_ = std::max(side_, std::sqrt(area / (4.0 * static_cast<double>(points.size()) + 16.0)));
    side_ = std::max(side_, std::max(greatest[0] - least_[0], greatest[1] - least_[1]) /
                                (4.0 * static_cast<double>(points.size()) + 16.0));
    if (!(side_ > 0.0)) side_ = 1.0;
    for (std::size_t k = 0; k < 2; ++k) count_[k] = static_cast<int>((greatest[k] - least_[k]) / side_) + 1;
    std::vector<int> filled(static_cast<std::size_t>(count_[0]) * count_[1] + 1, 0);
    for (const Vec2& p : points) ++filled[bin(p) + 1];
    for (std::size_t b = 1; b < filled.size(); ++b) filled[b] += filled[b - 1];
    offset_ = filled;
    index_.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      index_[static_cast<std::size_t>(filled[bin(points[i])]++)] = static_cast<int>(i);
  }

  // Calls use(j) for every point with |dx| and |dy| at most `reach`.
  template <class Use>
  void within(const Vec2& centre, double reach, Use use) const {
    const auto at = [&](double x, std::size_t k) {
      return std::clamp(static_cast<int>(std::floor((x - least_[k]) / side_)), 0, count_[k] - 1);
    };
    for (int j = at(centre[1] - reach, 1); j <= at(centre[1] + reach, 1); ++j)
      for (int i = at(centre[0] - reach, 0); i <= at(centre[0] + reach, 0); ++i) {
        const std::size_t b = static_cast<std::size_t>(j) * count_[0] + i;
        for (int k = offset_[b]; k < offset_[b + 1]; ++k) {
          const Vec2& p = points_[index_[k]];
          if (std::abs(p[0] - centre[0]) <= reach && std::abs(p[1] - centre[1]) <= reach) use(index_[k]);
        }
      }
  }
  [[nodiscard]] double side() const { return side_; }

private:
  [[nodiscard]] std::size_t bin(const Vec2& p) const {
    std::array<int, 2> at{};
    for (std::size_t k = 0; k < 2; ++k)
      at[k] = std::clamp(static_cast<int>((p[k] - least_[k]) / side_), 0, count_[k] - 1);
    return static_cast<std::size_t>(at[1]) * count_[0] + at[0];
  }
  const std::vector<Vec2>& points_;
  double side_;
  std::array<double, 2> least_ = {HUGE_VAL, HUGE_VAL};
  std::array<int, 2> count_ = {1, 1};
  std::vector<int> offset_, index_;
};

}  // namespace weaveform::dic
