#include "mesher/lattice/fit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weaveform::lattice {

namespace {

// Lines of one family, by their positions across: origin + n spacing.
struct Lines {
  double spacing = 0.0;  // mm
  double origin = 0.0;   // mm
  [[nodiscard]] double nearest(double position) const { return std::round((position - origin) / spacing); }
};

// Positions (mm) across one family's lines that a line should pass through.
struct Targets {
  std::vector<double> bound;  // ends that bound a zone
  std::vector<double> tip;
  double asked = 0.0;  // mm; spacing
};

Targets find_targets(const Outline& outline, const GripRegions& grips, std::size_t axis, double asked) {
  Targets targets{{}, {}, asked};
  const Box box = bounding_box(outline);
  for (const auto& region : grips.region) {
    for (const auto& end : region.end) {
      const double beyond = std::min(end[axis] - box.low[axis], box.high[axis] - end[axis]);
      (beyond <= grips.tolerance ? targets.tip : targets.bound).push_back(end[axis]);
    }
  }
  return targets;
}

std::vector<double> all_of(const Targets& targets) {
  std::vector<double> all = targets.bound;
  all.insert(all.end(), targets.tip.begin(), targets.tip.end());
  std::sort(all.begin(), all.end());
  return all;
}

double misfit(const Lines& lines, const std::vector<double>& positions) {
  double sum = 0.0;
  for (const double p : positions) {
    const double off = (p - lines.origin) / lines.spacing - lines.nearest(p);
    sum += off * off;
  }
  return sum;
}

double cost(const Lines& lines, const Targets& targets) {
  const double stretch = lines.spacing / targets.asked - 1.0;
  return misfit(lines, targets.bound) + tip_weight * misfit(lines, targets.tip) + spacing_weight * stretch * stretch;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// The straight line p = origin + n spacing of least squares through the positions, each at the number n of its nearest
// line; exact when they can all be met. False when one line serves them all: that says nothing about the spacing.
bool regress(const std::vector<double>& positions, double asked, Lines& lines) {
  if (positions.empty()) return false;
  std::vector<double> number;
  for (const double p : positions) number.push_back(lines.nearest(p));
  const double middle_number = mean(number);
  const double middle = mean(positions);
  double scatter = 0.0;
  double product = 0.0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const double n = number[k] - middle_number;
    scatter += n * n;
    product += n * (positions[k] - middle);
  }
  if (scatter > 0.0)
    lines.spacing = std::clamp(product / scatter, (1.0 - most_stretch) * asked, (1.0 + most_stretch) * asked);
  lines.origin = middle - middle_number * lines.spacing;
  return scatter > 0.0;
}

bool symmetric(const std::vector<double>& sorted, double tolerance) {
  const double twice_middle = sorted.front() + sorted.back();
  for (std::size_t k = 0; k < sorted.size(); ++k)
    if (std::abs(sorted[k] + sorted[sorted.size() - 1 - k] - twice_middle) > tolerance) return false;
  return true;
}

// Where lines of a given spacing may begin: for symmetric ends with a line or a gap in their middle, so that a
// symmetric test gets a symmetric mesh; else with a line through any of the ends.
std::vector<double> origins(const std::vector<double>& sorted, double spacing, double tolerance) {
  if (!symmetric(sorted, tolerance)) return sorted;
  const double middle = 0.5 * (sorted.front() + sorted.back());
  return {middle, middle + 0.5 * spacing};
}

// The scan finds which line each end belongs to; the regression then places the lines. An end changes its line when
// the spacing changes by its own fraction 1 / (lines between the ends): four steps to each such change.
Lines best_lines(const Targets& targets, double tolerance) {
  const std::vector<double> all = all_of(targets);
  Lines best{targets.asked, 0.0};
  if (all.empty()) return best;
  double least = cost(best, targets);
  const double between = (all.back() - all.front()) / targets.asked;
  const int steps = std::max(100, static_cast<int>(std::ceil(4.0 * most_stretch * between)));  // to either side
  for (int k = -steps; k <= steps; ++k) {
    const double spacing = targets.asked * (1.0 + most_stretch * k / steps);
    for (const double origin : origins(all, spacing, tolerance)) {
      Lines lines{spacing, origin};
      if (!regress(targets.bound, targets.asked, lines)) regress(all, targets.asked, lines);
      const double here = cost(lines, targets);
      // Rounding must not decide between layouts that are alike.
      if (here >= least - 1e-12) continue;
      best = lines;
      least = here;
    }
  }
  return best;
}

// In [-1/2, 1/2], to 2^-32 of a spacing: far below the net's tolerance, and lines meant for the middle get there.
double phase_of(const Lines& lines) {
  constexpr double grain = 4294967296.0;
  const double phase = lines.origin / lines.spacing;
  return std::round((phase - std::round(phase)) * grain) / grain;
}

}  // namespace

LineLayout fit_lines(const Outline& outline, const GripRegions& grips, const Vec2& asked) {
  LineLayout layout;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Lines lines = best_lines(find_targets(outline, grips, axis, asked[axis]), grips.tolerance);
    layout.spacing[axis] = lines.spacing;
    // Positions along the warp (axis 0) are those of the weft lines, which phase[1] moves.
    layout.phase[1 - axis] = phase_of(lines);
  }
  return layout;
}

}  // namespace weaveform::lattice
