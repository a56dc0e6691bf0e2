#include "core/chart/chart_json.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/chart/chart_text.hpp"

namespace weaveform {
namespace {

using ChartJson = nlohmann::ordered_json;

// JSON knows no number that is not finite; the drawing leaves a gap at null.
ChartJson finite_or_null(double value) {
  return std::isfinite(value) ? ChartJson(value) : ChartJson(nullptr);
}

// Columns of one table under their names, as long as the shortest; `most` of the rows, evenly, with both ends.
void add_columns(ChartJson& json, std::initializer_list<std::pair<const char*, const std::vector<double>*>> columns,
                 std::size_t most) {
  std::size_t rows = columns.begin()->second->size();
  for (const auto& column : columns) rows = std::min(rows, column.second->size());
  const std::size_t kept = std::min(rows, most);
  for (const auto& [name, values] : columns) {
    ChartJson list = ChartJson::array();
    for (std::size_t k = 0; k < kept; ++k)
      list.push_back(finite_or_null((*values)[kept > 1 ? k * (rows - 1) / (kept - 1) : 0]));
    json[name] = std::move(list);
  }
}

const char* style_of(ChartMark mark) {
  return mark == ChartMark::points ? "points" : mark == ChartMark::dashed ? "dashed" : "line";
}

ChartJson axis_json(const ChartAxis& axis) {
  ChartJson json = {{"title", chart_text(axis.title)}, {"log", axis.scale == AxisScale::logarithmic}};
  if (axis.from) json["from"] = finite_or_null(*axis.from);
  if (axis.to) json["to"] = finite_or_null(*axis.to);
  return json;
}

ChartJson series_json(const ChartSeries& series, std::size_t most_points) {
  ChartJson json = {{"name", chart_text(series.label)}};
  const std::size_t most = series.mark == ChartMark::points ? series.x.size() : most_points;
  if (series.y_low.empty() || series.y_high.empty())
    add_columns(json, {{"x", &series.x}, {"y", &series.y}}, most);
  else {
    // Those that have no bar have none, too, where the list of bars ends.
    std::vector<double> low = series.y_low, high = series.y_high;
    low.resize(series.x.size(), NAN);
    high.resize(series.x.size(), NAN);
    add_columns(json, {{"x", &series.x}, {"y", &series.y}, {"y_low", &low}, {"y_high", &high}}, most);
  }
  json["style"] = style_of(series.mark);
  if (series.colour >= 0) json["colour"] = series.colour;
  if (series.shape >= 0) json["shape"] = series.shape;
  return json;
}

ChartJson band_json(const ChartBand& band, std::size_t most_points) {
  ChartJson json = {{"name", chart_text(band.label)}};
  add_columns(json, {{"x", &band.x}, {"low", &band.low}, {"high", &band.high}}, most_points);
  if (band.colour >= 0) json["colour"] = band.colour;
  return json;
}

}  // namespace

ChartJson chart_json(const std::string& id, const Chart& chart, bool square, std::size_t most_points) {
  ChartJson json = {
      {"id", id}, {"title", chart_text(chart.title)}, {"x", axis_json(chart.x)}, {"y", axis_json(chart.y)}};
  for (const char* list : {"series", "bands", "notes", "marks"}) json[list] = ChartJson::array();
  for (const ChartSeries& series : chart.series) json["series"].push_back(series_json(series, most_points));
  for (const ChartBand& band : chart.bands) json["bands"].push_back(band_json(band, most_points));
  for (const ChartNote& note : chart.notes)
    json["notes"].push_back(
        {{"x", finite_or_null(note.x)}, {"y", finite_or_null(note.y)}, {"text", chart_text(note.text)}});
  json["square"] = square;
  return json;
}

void add_mark(ChartJson& chart, double x, const std::string& label) {
  chart["marks"].push_back({{"x", x}, {"label", label}});
}

}  // namespace weaveform
