#include "solver/contact/ply_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/contact/contact_kernel.hpp"

namespace weaveform {
namespace {

// Plies stacked by their thickness touch without pressing, whatever rounding makes of their places.
constexpr double touching = 1e-9;                             // mm
constexpr int most_intervals = 4096, least_intervals = 1024;  // of a table

using Points = std::vector<std::array<double, 2>>;

double value_of(const Points& points, double x) {
  if (x <= points.front()[0]) return points.front()[1];
  for (std::size_t k = 1; k < points.size(); ++k)
    if (x <= points[k][0]) {
      const double part = (x - points[k - 1][0]) / (points[k][0] - points[k - 1][0]);
      return points[k - 1][1] + part * (points[k][1] - points[k - 1][1]);
    }
  return points.back()[1];
}

// From 0 to `end` or a little further.
struct Intervals {
  int count = 0;
  double step = 0.0;  // mm
};

// A whole number of them fits between evenly spaced points, which are met then.
Intervals intervals_of(const Points& points, double end, int least) {
  double shortest = end;
  for (std::size_t k = 1; k < points.size(); ++k) shortest = std::min(shortest, points[k][0] - points[k - 1][0]);
  shortest = std::max(shortest, end / most_intervals);
  const double step = shortest / std::ceil(shortest * least / end);
  return {static_cast<int>(std::ceil(end / step - 1e-6)), step};
}

std::string wrong_points(const char* what, const Points& points) {
  double before = -1.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!std::isfinite(points[k][0]) || !std::isfinite(points[k][1]) || points[k][0] < 0.0 || points[k][1] < 0.0)
      return fmt::format("point {} of the {} is ({:.6g}, {:.6g}); both must be numbers from 0 on", k + 1, what,
                         points[k][0], points[k][1]);
    if (points[k][0] <= before)
      return fmt::format("point {} of the {} is at {:.6g} mm, after {:.6g} mm; they must rise", k + 1, what,
                         points[k][0], before);
    before = points[k][0];
  }
  return "";
}

}  // namespace

std::string wrong_law(const PairLaw& law) {
  if (!(law.friction >= 0.0) || !std::isfinite(law.friction))
    return fmt::format("friction is {}; it must be 0 or more", law.friction);
  if (auto wrong = wrong_points("friction law", law.shear_law); !wrong.empty()) return wrong;
  if (auto wrong = wrong_points("compaction", law.compaction); !wrong.empty()) return wrong;
  for (std::size_t k = 1; k < law.compaction.size(); ++k)
    if (law.compaction[k][1] < law.compaction[k - 1][1])
      return fmt::format("point {} of the compaction has less pressure ({:.6g} MPa) than the one before ({:.6g} MPa)",
                         k + 1, law.compaction[k][1], law.compaction[k - 1][1]);
  if (!law.compaction.empty() && law.compaction.back()[1] <= 0.0) return "the compaction has no pressure";
  return "";
}

double reach_of(const TouchingPly& a, const TouchingPly& b) {
  return 0.5 * (a.thickness + b.thickness) - touching;
}

double spring_stiffness(const TouchingPly& a, const TouchingPly& b, double frequency) {
  return frequency * frequency * a.density * b.density / (a.density + b.density);
}

double node_stiffness(const TouchingPly& own, const TouchingPly& other, double frequency, double mass, double area) {
  const double there = std::min(other.density * area, other.node_mass);
  if (mass <= 0.0 || there <= 0.0) return 0.0;
  const double share = own.thickness / (own.thickness + other.thickness);
  return share * frequency * frequency * mass * there / (mass + there);
}

void make_tables(const PairLaw& law, const TouchingPly& a, const TouchingPly& b, double frequency, PairTables& tables) {
  if (!law.shear_law.empty()) {
    const double end = std::max(law.shear_law.back()[0], 1e-6);
    const auto [count, step] = intervals_of(law.shear_law, end, 1);
    for (int k = 0; k <= count; ++k) tables.shear.push_back(value_of(law.shear_law, step * k));
    tables.shear_table = {.value = tables.shear.data(), .per_unit = 1.0 / step, .intervals = count, .last_slope = 0.0};
  }
  if (law.compaction.empty()) return;
  Points points = law.compaction;
  if (points.front()[0] > 0.0) points.insert(points.begin(), {0.0, 0.0});
  const double end = std::max(points.back()[0], reach_of(a, b));
  const auto [count, step] = intervals_of(points, end, least_intervals);
  const auto last_point = points.back(), before_last = points[points.size() - 2];
  const double slope = (last_point[1] - before_last[1]) / (last_point[0] - before_last[0]);
  points.push_back({last_point[0] + 2.0 * end, last_point[1] + 2.0 * slope * end});  // goes on with its last slope
  const double most = spring_stiffness(a, b, frequency);
  tables.softened_from = end;
  tables.pressure.push_back(value_of(points, 0.0));
  tables.pressure_energy.push_back(0.0);
  for (int k = 1; k <= count; ++k) {
    const double rise = value_of(points, step * k) - value_of(points, step * (k - 1));
    const double taken = std::min(rise, most * step);
    if (rise > most * step * (1.0 + 1e-9)) tables.softened_from = std::min(tables.softened_from, step * (k - 1));
    tables.stiffest = std::max(tables.stiffest, taken / step);
    const double before = tables.pressure.back();
    tables.pressure.push_back(before + taken);
    tables.pressure_energy.push_back(tables.pressure_energy.back() + 0.5 * step * (before + before + taken));
  }
  const double last = tables.pressure.back() - tables.pressure[count - 1];
  tables.pressure_table = {
      .value = tables.pressure.data(), .per_unit = 1.0 / step, .intervals = count, .last_slope = last};
  tables.energy_table = {.value = tables.pressure_energy.data(),
                         .per_unit = 1.0 / step,
                         .intervals = count,
                         .last_slope = tables.pressure_energy.back() - tables.pressure_energy[count - 1]};
}

PlyPassLaw pass_law(const PairLaw& law, const PairTables& tables, const TouchingPly& own, const TouchingPly& other,
                    bool above, double frequency) {
  const double reach = reach_of(own, other), arm = reach / own.spacing;
  const double softening = contact_softening * std::min(own.thickness, other.thickness);
  return {.reach = reach,
          .side = above ? 1.0 : -1.0,
          .softening = softening,
          .damping_time = 2.0 * contact_damping / frequency,
          .tangential = 1.0 / ((1.0 + arm) * (1.0 + 2.0 * arm)),
          .friction = law.friction,
          .share = own.thickness / (own.thickness + other.thickness),
          .shear = tables.shear_table,
          .adhesion = law.shear_law.empty() ? 0.0 : -softening,
          .pressure = tables.pressure_table,
          .pressure_energy = tables.energy_table,
          .half_own = 0.5 * own.thickness,
          .half_other = 0.5 * other.thickness};
}

}  // namespace weaveform
