#include "post/dic/virtual/step_width.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "core/missing.hpp"

namespace weaveform::dic {
std::array<double, 2> end_angles(const std::vector<double>& angle) {
  std::vector<double> a;
  std::copy_if(angle.begin(), angle.end(), std::back_inserter(a), [](double value) { return std::isfinite(value); });
  const auto fifth = static_cast<std::ptrdiff_t>(a.size() / 5);
  if (fifth == 0) return {missing, missing};
  return {std::accumulate(a.begin(), a.begin() + fifth, 0.0) / static_cast<double>(fifth),
          std::accumulate(a.end() - fifth, a.end(), 0.0) / static_cast<double>(fifth)};
}

double step_width(const std::vector<double>& distance, const std::vector<double>& angle) {
  const auto [from, to] = end_angles(angle);
  return step_width(distance, angle, from, to);
}

double step_width(const std::vector<double>& distance, const std::vector<double>& angle, double from, double to) {
  constexpr double half_a_degree = 0.5 * std::numbers::pi / 180.0;
  if (!(std::abs(to - from) >= half_a_degree)) return missing;
  std::vector<double> s, way;
  for (std::size_t i = 0; i < angle.size(); ++i)
    if (std::isfinite(angle[i])) {
      s.push_back(distance[i]);
      way.push_back((angle[i] - from) / (to - from));
    }
  // The last place below 10 % before the first above 90 %: noise on the plateaus does not widen the step.
  std::size_t high = 0;
  while (high < way.size() && way[high] < 0.9) ++high;
  if (high == 0 || high == way.size()) return missing;
  std::size_t low = high;
  while (low > 0 && way[low] > 0.1) --low;
  if (way[low] > 0.1) return missing;
  const auto crossing = [&](std::size_t below, double level) {
    return s[below] + (level - way[below]) / (way[below + 1] - way[below]) * (s[below + 1] - s[below]);
  };
  return crossing(high - 1, 0.9) - crossing(low, 0.1);
}

}  // namespace weaveform::dic
