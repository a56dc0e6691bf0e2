#include "app/study/work_precision.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace weaveform::study {

namespace {

constexpr std::array units = {"deg", "N", "mJ", "mm", "mm2", "s"};

WorkPoint point_of(std::size_t row, const Row& from, double result, const Reference& reference, bool absolute) {
  const double scale = absolute ? 1.0 : std::abs(reference.value);
  return {row,  from.wall, reference.value, std::abs(result - reference.value) / scale, reference.uncertainty / scale,
          false};
}

// An error below the reference's uncertainty wins nothing: it may be luck.
void mark_front(WorkPrecision& one) {
  std::vector<double> time, error;
  for (const WorkPoint& point : one.point) {
    time.push_back(point.time);
    error.push_back(point.known_error());
  }
  for (const std::size_t i : pareto_front(time, error)) one.point[i].on_front = true;
}

}  // namespace

std::string unit_of(const std::string& measure) {
  std::string name = measure;
  if (name.ends_with(')')) name.pop_back();
  const auto bar = name.rfind('_');
  if (bar == std::string::npos) return "%";
  const std::string unit = name.substr(bar + 1);
  return std::find(units.begin(), units.end(), unit) != units.end() ? unit : "%";
}

std::vector<WorkPrecision> work_precision_of(const Study& study, const std::vector<std::string>& measures,
                                             const std::vector<ConvergenceOf>& convergence, const Table& table,
                                             std::vector<std::string>& complaints) {
  const auto& absolute = study.work_precision->absolute;
  std::vector<WorkPrecision> all;
  for (const std::string& measure : measures) {
    WorkPrecision one{measure, {}};
    const bool is_absolute = std::find(absolute.begin(), absolute.end(), measure) != absolute.end();
    if (is_absolute) one.unit = unit_of(measure);
    const auto reference = references(study, measure, convergence, table, complaints);
    const std::size_t column = column_of(table, measure);
    for (std::size_t i = 0; i < table.row.size(); ++i)
      if (reference[i])
        one.point.push_back(point_of(i, table.row[i], table.row[i].value[column], *reference[i], is_absolute));
    mark_front(one);
    if (!one.point.empty()) all.push_back(std::move(one));
  }
  return all;
}

const WorkPoint* cheapest_within(std::span<const WorkPrecision> measures, const Table& table, const std::string& series,
                                 const std::vector<double>& tolerance) {
  const auto within = [&](std::size_t row) {
    for (std::size_t m = 0; m < measures.size(); ++m) {
      const auto& points = measures[m].point;
      const auto found =
          std::find_if(points.begin(), points.end(), [&](const auto& point) { return point.row == row; });
      if (found == points.end() || !(found->error + found->floor <= tolerance[m])) return false;
    }
    return true;
  };
  const WorkPoint* cheapest = nullptr;
  for (const WorkPoint& point : measures.front().point) {
    const bool fits = series.empty() || table.row[point.row].one.series == series;
    if (fits && within(point.row) && (cheapest == nullptr || point.time < cheapest->time)) cheapest = &point;
  }
  return cheapest;
}

}  // namespace weaveform::study
