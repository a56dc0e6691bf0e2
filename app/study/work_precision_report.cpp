#include "app/study/work_precision_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "post/report/words.hpp"

namespace weaveform::study {

namespace {

std::vector<WorkPoint> in_order_of_time(const WorkPrecision& one) {
  std::vector<WorkPoint> sorted = one.point;
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.time < b.time; });
  return sorted;
}

// As errors are told to people: in percent, or in the measure's unit.
double shown(const WorkPrecision& one, double error) {
  return one.in_percent() ? 100.0 * error : error;
}

std::string error_words(const WorkPrecision& one, double error) {
  return fmt::format("{:.3g} {}", shown(one, error), one.unit);
}

// In the order of the table; "" for cases without one.
std::vector<std::string> series_of(const WorkPrecision& one, const Table& table) {
  std::vector<std::string> names;
  for (const WorkPoint& point : one.point) {
    const std::string& name = table.row[point.row].one.series;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::string front_table(const WorkPrecision& one, const Table& table) {
  std::string text = "| Pareto front | solve | error |\n|---|---:|---:|\n";
  for (const WorkPoint& point : in_order_of_time(one)) {
    if (!point.on_front) continue;
    const std::string error = point.within_uncertainty()
                                  ? fmt::format("within the uncertainty, {}", error_words(one, point.floor))
                                  : error_words(one, point.error);
    text +=
        fmt::format("| {} | {:.3g} s | {} |\n", short_description(table.row[point.row].one, table), point.time, error);
  }
  return text;
}

const std::vector<double>& tolerances(const WorkPrecisionSpec& spec, const WorkPrecision& one) {
  return one.in_percent() ? spec.within : spec.within_absolute;
}

// Tolerance number k of each measure, and in words, those that several share once.
std::vector<double> tolerance_of_each(const WorkPrecisionSpec& spec, std::span<const WorkPrecision> measures,
                                      std::size_t k) {
  std::vector<double> each;
  for (const WorkPrecision& one : measures) each.push_back(tolerances(spec, one)[k]);
  return each;
}

std::string tolerance_words(const WorkPrecisionSpec& spec, std::span<const WorkPrecision> measures, std::size_t k) {
  std::vector<std::string> words;
  for (const WorkPrecision& one : measures) {
    const std::string word = error_words(one, tolerances(spec, one)[k]);
    if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

// Tolerances that all of the measures have.
std::size_t tolerance_count(const WorkPrecisionSpec& spec, std::span<const WorkPrecision> measures) {
  std::size_t count = spec.within.size();
  for (const WorkPrecision& one : measures) count = std::min(count, tolerances(spec, one).size());
  return count;
}

// "" for all cases, then the series.
std::vector<std::string> all_and_series(std::span<const WorkPrecision> measures, const Table& table) {
  std::vector<std::string> series = series_of(measures.front(), table);
  std::erase(series, "");
  series.insert(series.begin(), "");
  return series;
}

// The cheapest case within each tolerance, for all of the measures at once; of all cases and of each series.
std::string choice_table(const WorkPrecisionSpec& spec, std::span<const WorkPrecision> measures, const Table& table) {
  const std::size_t columns = tolerance_count(spec, measures);
  std::string text = "| cheapest within |", rule = "|---|";
  for (std::size_t k = 0; k < columns; ++k) {
    text += fmt::format(" {} |", tolerance_words(spec, measures, k));
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const std::string& name : all_and_series(measures, table)) {
    text += fmt::format("| {} |", name.empty() ? "all" : name);
    for (std::size_t k = 0; k < columns; ++k) {
      const WorkPoint* point = cheapest_within(measures, table, name, tolerance_of_each(spec, measures, k));
      text += point == nullptr
                  ? " none |"
                  : fmt::format(" {}: {:.3g} s |", short_description(table.row[point->row].one, table), point->time);
    }
    text += "\n";
  }
  return text;
}

// The same as a list.
nlohmann::ordered_json choice_json(const WorkPrecisionSpec& spec, std::span<const WorkPrecision> measures,
                                   const Table& table) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  for (const std::string& name : all_and_series(measures, table))
    for (std::size_t k = 0; k < tolerance_count(spec, measures); ++k) {
      const std::vector<double> tolerance = tolerance_of_each(spec, measures, k);
      const WorkPoint* point = cheapest_within(measures, table, name, tolerance);
      list.push_back({{"series", name},
                      {"tolerance", tolerance},
                      {"case", point != nullptr ? Json(table.row[point->row].one.name) : Json(nullptr)},
                      {"wall_s", point != nullptr ? Json(point->time) : Json(nullptr)}});
    }
  return list;
}

nlohmann::ordered_json points_json(const WorkPrecision& one, const Table& table) {
  auto list = nlohmann::ordered_json::array();
  for (const WorkPoint& point : one.point) {
    const Row& row = table.row[point.row];
    list.push_back({{"case", row.one.name},
                    {"series", row.one.series},
                    {"wall_s", point.time},
                    {"result", row.value[column_of(table, one.measure)]},
                    {"reference", point.reference},
                    {"error", point.error},
                    {"reference_uncertainty", point.floor},
                    {"within_uncertainty", point.within_uncertainty()},
                    {"pareto_front", point.on_front}});
  }
  return list;
}

}  // namespace

std::string chart_name(const std::string& measure) {
  std::string name = measure;
  std::replace_if(
      name.begin(), name.end(),
      [](unsigned char c) { return std::isalnum(c) == 0 && c != '.' && c != '_' && c != '-'; }, '_');
  return "work_precision_" + name + ".svg";
}

Chart work_precision_chart(const WorkPrecision& one, const Table& table) {
  Chart chart;
  chart.title = measure_in_words(one.measure);
  chart.x = {.title = "time of the solve (s)", .scale = AxisScale::logarithmic};
  chart.y = {.title = fmt::format("error ({})", one.unit), .scale = AxisScale::logarithmic};
  const std::vector<WorkPoint> sorted = in_order_of_time(one);
  ChartSeries front{.label = "Pareto front"};
  ChartSeries floor{.label = "uncertainty of the reference", .mark = ChartMark::dashed};
  for (const WorkPoint& point : sorted) {
    floor.x.push_back(point.time);
    floor.y.push_back(shown(one, point.floor));
    if (!point.on_front) continue;
    front.x.push_back(point.time);
    front.y.push_back(shown(one, point.known_error()));
    chart.notes.push_back(
        {short_description(table.row[point.row].one, table), point.time, shown(one, point.known_error())});
  }
  chart.series = {front};
  for (const std::string& name : series_of(one, table)) {
    ChartSeries cases{.label = name.empty() ? "cases" : name, .mark = ChartMark::points};
    for (const WorkPoint& point : sorted) {
      if (table.row[point.row].one.series != name) continue;
      cases.x.push_back(point.time);
      // An error of 0, of a level that is its own limit, has no place on a logarithmic axis.
      cases.y.push_back(shown(one, point.error > 0.0 ? point.error : point.floor));
    }
    chart.series.push_back(cases);
  }
  const bool uncertain = std::any_of(sorted.begin(), sorted.end(), [](const auto& point) { return point.floor > 0.0; });
  if (uncertain) chart.series.push_back(floor);
  return chart;
}

std::string work_precision_markdown(const WorkPrecisionSpec& spec, const std::vector<WorkPrecision>& all,
                                    const Table& table) {
  std::string text = "Time against error\n";
  for (const WorkPrecision& one : all)
    text += fmt::format("\n{}\n\n{}\n{}", measure_in_words(one.measure), front_table(one, table),
                        choice_table(spec, {&one, 1}, table));
  if (all.size() > 1) text += "\nAll of these measures at once\n\n" + choice_table(spec, all, table);
  return text;
}

nlohmann::ordered_json work_precision_json(const WorkPrecisionSpec& spec, const std::vector<WorkPrecision>& all,
                                           const Table& table) {
  using Json = nlohmann::ordered_json;
  Json json = {{"measures", Json::array()}, {"all_measures", Json::array()}};
  for (const WorkPrecision& one : all)
    json["measures"].push_back({{"measure", one.measure},
                                {"error_unit", one.in_percent() ? "1" : one.unit},
                                {"points", points_json(one, table)},
                                {"cheapest_within", choice_json(spec, {&one, 1}, table)}});
  if (!all.empty()) json["all_measures"] = choice_json(spec, all, table);
  return json;
}

std::string work_precision_csv(const std::vector<WorkPrecision>& all, const Table& table) {
  std::string text = "measure,case,series";
  for (const std::string& key : table.keys) add_field(text, csv_field(key));
  text += ",wall_s,result,reference,error,error_unit,reference_uncertainty,within_uncertainty,pareto_front\n";
  for (const WorkPrecision& one : all) {
    const std::size_t column = column_of(table, one.measure);
    for (const WorkPoint& point : one.point) {
      const Row& row = table.row[point.row];
      text += csv_field(one.measure) + "," + row.one.name + "," + csv_field(row.one.series);
      for (const std::string& key : table.keys) add_field(text, csv_field(plain_value(row.one, key)));
      text += fmt::format(",{},{},{},{},{},{},{},{}\n", csv_number(point.time, 4), csv_number(row.value[column]),
                          csv_number(point.reference), csv_number(point.error, 6), one.in_percent() ? "1" : one.unit,
                          csv_number(point.floor, 6), point.within_uncertainty() ? 1 : 0, point.on_front ? 1 : 0);
    }
  }
  return text;
}

}  // namespace weaveform::study
