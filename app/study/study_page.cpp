#include "app/study/study_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/study/case_files.hpp"
#include "app/study/report.hpp"
#include "core/chart/chart_json.hpp"
#include "core/files/files.hpp"
#include "core/version/version.hpp"
#include "post/report/page.hpp"
#include "post/report/result_report.hpp"
#include "post/report/words.hpp"

namespace weaveform::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string outcome_words(const Row& row) {
  if (!row.outcome) return "not run";
  return is_done(row) ? "done" : row.outcome->error;
}

Json shown(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json case_link(const Row& row, const fs::path& study_folder) {
  const fs::path page = case_files(study_folder, row.one.name).results / weaveform::file_name::report;
  return is_done(row) && fs::exists(page) ? Json(page.lexically_relative(study_folder).generic_string())
                                          : Json(nullptr);
}

Json case_table(const Table& table, std::size_t measure_columns, const fs::path& study_folder) {
  Json json = {
      {"title", "Cases"}, {"columns", Json::array({"case"})}, {"rows", Json::array()}, {"links", Json::array()}};
  for (const std::string& key : table.keys) json["columns"].push_back(key);
  json["columns"].push_back("outcome");
  json["columns"].push_back("cell size (mm)");
  for (std::size_t m = 0; m < measure_columns; ++m) json["columns"].push_back(measure_in_words(table.measures[m]));
  for (const Row& row : table.row) {
    Json cells = Json::array({short_description(row.one, table)});
    for (const std::string& key : table.keys) cells.push_back(plain_value(row.one, key));
    cells.push_back(outcome_words(row));
    cells.push_back(shown(row.size));
    for (std::size_t m = 0; m < measure_columns; ++m) cells.push_back(shown(row.value[m]));
    json["rows"].push_back(std::move(cells));
    json["links"].push_back(case_link(row, study_folder));
  }
  return json;
}

// A measure over the cell size, a line for each series of cases; nothing where all cells are of one size.
std::optional<Chart> size_chart(const Table& table, std::size_t measure) {
  Chart chart{.title = measure_in_words(table.measures[measure])};
  chart.title += " over the cell size";
  chart.x = {.title = "cell size (mm)", .scale = AxisScale::logarithmic};
  chart.y.title = measure_in_words(table.measures[measure]);
  double least = 1e300, most = 0.0;
  for (const Row& row : table.row) {
    if (!is_done(row) || !std::isfinite(row.value[measure]) || !(row.size > 0.0)) continue;
    auto series = std::find_if(chart.series.begin(), chart.series.end(),
                               [&](const ChartSeries& s) { return s.label == row.one.series; });
    if (series == chart.series.end())
      series = chart.series.insert(series, {.label = row.one.series, .mark = ChartMark::points});
    series->x.push_back(row.size);
    series->y.push_back(row.value[measure]);
    least = std::min(least, row.size);
    most = std::max(most, row.size);
  }
  if (!(most > least * (1.0 + 1e-9))) return {};
  if (chart.series.size() == 1 && chart.series.front().label.empty()) chart.series.front().label = "cases";
  return chart;
}

Json charts_of(const Table& table, std::size_t measure_columns, const StudyPage& page) {
  Json charts = Json::array();
  for (std::size_t k = 0; k < page.charts.size(); ++k)
    charts.push_back(chart_json(fmt::format("study_{}", k), page.charts[k]));
  for (std::size_t m = 0; m < measure_columns; ++m)
    if (const auto chart = size_chart(table, m)) charts.push_back(chart_json(fmt::format("size_{}", m), *chart));
  return charts;
}

Json verdict_of(const Table& table, const StudyPage& page) {
  const auto done = std::count_if(table.row.begin(), table.row.end(), is_done);
  const auto missing = std::count_if(table.row.begin(), table.row.end(), [](const Row& row) { return !row.outcome; });
  const auto failed = static_cast<std::ptrdiff_t>(table.row.size()) - done - missing;
  double wall = 0.0;
  for (const Row& row : table.row)
    if (std::isfinite(row.wall)) wall += row.wall;
  Json rows = Json::array();
  const auto add = [&](const char* name, const std::string& value, const char* note) {
    rows.push_back({{"name", name}, {"value", value}, {"note", note}});
  };
  add("cases done", fmt::format("{} of {}", done, table.row.size()), "");
  if (failed > 0) add("cases failed", fmt::format("{}", failed), "why is in the table");
  if (missing > 0) add("cases not run", fmt::format("{}", missing), "");
  add("time of all solves", fmt::format("{:.3g} s", wall), "");
  return {{"headline", fmt::format("{} of {} cases are done{}.", done, table.row.size(),
                                   failed > 0 ? fmt::format(", {} failed", failed) : "")},
          {"rows", rows},
          {"warnings", page.complaints},
          {"trust", Json::array()}};
}

}  // namespace

void write_study_page(const Study& study, const Table& table, std::size_t measure_columns, const StudyPage& page,
                      const fs::path& study_folder) {
  Json data = {{"format", 1},
               {"kind", "study"},
               {"title", study.file.stem().string()},
               {"subtitle", fmt::format("a study of {}", scene_path(study).filename().string())},
               {"verdict", verdict_of(table, page)},
               {"part", nullptr},
               {"tools", Json::array()},
               {"measured", nullptr},
               {"charts", charts_of(table, measure_columns, page)},
               {"tables", Json::array({case_table(table, measure_columns, study_folder)})},
               {"texts", Json::array()},
               {"facts", Json::array({Json::array({"program", version_line()})})}};
  for (const auto& [title, text] : page.answers) data["texts"].push_back({{"title", title}, {"text", text}});
  data["texts"].push_back({{"title", "Study"}, {"text", read_text_file(study.file)}});
  write_text_whole(study_folder / report_name::page, report_page(data));
}

void write_case_reports(const Table& table, const fs::path& study_folder) {
  for (const Row& row : table.row) {
    if (!is_done(row)) continue;
    const fs::path results = case_files(study_folder, row.one.name).results;
    const fs::path page = results / weaveform::file_name::report;
    std::error_code unknown;
    if (fs::exists(page) &&
        fs::last_write_time(page, unknown) >= fs::last_write_time(results / weaveform::file_name::summary, unknown))
      continue;
    ResultFolder folder(results);
    write_report_page(folder, evaluate(folder), page);
  }
}

}  // namespace weaveform::study
