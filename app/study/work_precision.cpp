#include "app/study/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "mesher/base/error.hpp"

namespace weaveform::study {

namespace {

bool is_done(const Row& row) {
  return row.outcome && row.outcome->exit_code == 0;
}

// The one case that has all the settings of [work_precision.case].
std::size_t reference_row(const Study& study, const Table& table) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < table.row.size(); ++i) {
    const auto has = [&](const Setting& wanted) {
      const Setting* setting = setting_of(table.row[i].one, wanted.key);
      if (setting == nullptr) return false;
      return setting->number && wanted.number ? *setting->number == *wanted.number : setting->value == wanted.value;
    };
    if (std::all_of(study.reference_case.begin(), study.reference_case.end(), has)) found.push_back(i);
  }
  const auto where = [&] {
    const auto& begin = study.reference_case.front().where.begin;
    return fmt::format("{}:{}:{}: [work_precision.case] ", study.file.string(), begin.line, begin.column);
  };
  if (found.size() != 1)
    throw InputError(where() + fmt::format("picks {} cases; give the varied keys so that it picks one", found.size()));
  if (!is_done(table.row[found[0]]))
    throw InputError(where() + "picks a case that is not done; choose another, see study.csv");
  return found[0];
}

WorkPoint point_of(std::size_t row, const Row& from, double result, double reference, double uncertainty) {
  return {
      row,  from.wall, reference, std::abs(result - reference) / std::abs(reference), uncertainty / std::abs(reference),
      false};
}

void add_limits(WorkPrecision& one, const std::vector<ConvergenceOf>& convergence, const Table& table,
                std::vector<std::string>& complaints) {
  for (const ConvergenceOf& group : convergence) {
    if (group.measure != one.measure) continue;
    const bool known =
        group.refinement &&
        (group.refinement->agreed || (!group.refinement->checked && group.refinement->finest.trend == Trend::monotone));
    if (!known) {
      const std::string reason = !group.refinement           ? "fewer than three levels"
                                 : group.refinement->checked ? "the levels do not agree on one"
                                                             : trend_words(group.refinement->finest.trend);
      complaints.push_back(
          fmt::format("work precision of {} {}: no limit to compare with ({})", one.measure, group.group, reason));
      continue;
    }
    for (std::size_t i = 0; i < group.level.size(); ++i)
      one.point.push_back(point_of(group.level[i].row, table.row[group.level[i].row], group.refinement->level[i].result,
                                   group.refinement->limit, group.refinement->uncertainty));
  }
}

void add_case(WorkPrecision& one, std::size_t reference, const Table& table) {
  const std::size_t column = column_of(table, one.measure);
  for (std::size_t i = 0; i < table.row.size(); ++i)
    if (i != reference && is_done(table.row[i]))
      one.point.push_back(
          point_of(i, table.row[i], table.row[i].value[column], table.row[reference].value[column], 0.0));
}

void mark_front(WorkPrecision& one) {
  std::vector<double> time, error;
  for (const WorkPoint& point : one.point) {
    time.push_back(point.time);
    error.push_back(point.error);
  }
  for (const std::size_t i : pareto_front(time, error)) one.point[i].on_front = true;
}

}  // namespace

std::string chart_name(const std::string& measure) {
  std::string name = measure;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '_' && c != '-'; }, '_');
  return "work_precision_" + name + ".svg";
}

std::vector<WorkPrecision> work_precision_of(const Study& study, const std::vector<std::string>& measures,
                                             const std::vector<ConvergenceOf>& convergence, const Table& table,
                                             std::vector<std::string>& complaints) {
  const bool by_case = study.work_precision->reference == "case";
  const std::size_t reference = by_case ? reference_row(study, table) : 0;
  std::vector<WorkPrecision> all;
  for (const std::string& measure : measures) {
    WorkPrecision one{measure, {}};
    if (by_case)
      add_case(one, reference, table);
    else
      add_limits(one, convergence, table, complaints);
    mark_front(one);
    if (!one.point.empty()) all.push_back(std::move(one));
  }
  return all;
}

Chart work_precision_chart(const WorkPrecision& one, const Table& table) {
  Chart chart;
  chart.title = one.measure;
  chart.x = {.title = "time of the solve (s)", .scale = AxisScale::logarithmic};
  chart.y = {.title = "error (%)", .scale = AxisScale::logarithmic};
  ChartSeries cases{.label = "cases", .mark = ChartMark::points};
  ChartSeries front{.label = "Pareto front"};
  ChartSeries floor{.label = "uncertainty of the reference", .mark = ChartMark::dashed};
  std::vector<WorkPoint> sorted = one.point;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  for (const WorkPoint& point : sorted) {
    cases.x.push_back(point.time);
    cases.y.push_back(100.0 * point.error);
    floor.x.push_back(point.time);
    floor.y.push_back(100.0 * point.floor);
    if (!point.on_front) continue;
    front.x.push_back(point.time);
    front.y.push_back(100.0 * point.error);
    chart.notes.push_back({describe(table.row[point.row].one), point.time, 100.0 * point.error});
  }
  chart.series = {front, cases};
  const bool uncertain = std::any_of(sorted.begin(), sorted.end(), [](const auto& point) { return point.floor > 0.0; });
  if (uncertain) chart.series.push_back(floor);
  return chart;
}

std::string work_precision_csv(const std::vector<WorkPrecision>& all, const Table& table) {
  std::string text = "measure,case";
  for (const std::string& key : table.keys) add_field(text, csv_field(key));
  text += ",wall_s,result,reference,relative_error,reference_uncertainty,pareto_front\n";
  for (const WorkPrecision& one : all) {
    const std::size_t column = column_of(table, one.measure);
    for (const WorkPoint& point : one.point) {
      const Row& row = table.row[point.row];
      text += csv_field(one.measure) + "," + row.one.name;
      for (const std::string& key : table.keys) {
        const Setting* setting = setting_of(row.one, key);
        add_field(text, (setting != nullptr ? csv_field(setting->value) : ""));
      }
      text += fmt::format(",{},{},{},{},{},{}\n", csv_number(point.time, 4), csv_number(row.value[column]),
                          csv_number(point.reference), csv_number(point.error, 6), csv_number(point.floor, 6),
                          point.on_front ? 1 : 0);
    }
  }
  return text;
}

}  // namespace weaveform::study
