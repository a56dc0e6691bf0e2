#include "post/report/chart_json.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace weaveform {
namespace {

using Json = nlohmann::ordered_json;

// JSON knows no number that is not finite; the page leaves a gap at null.
Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json thinned(const std::vector<double>& values, bool thin) {
  Json list = Json::array();
  const std::size_t count = values.size();
  const std::size_t kept = thin && count > most_points_of_a_line ? most_points_of_a_line : count;
  for (std::size_t k = 0; k < kept; ++k) list.push_back(finite(values[kept > 1 ? k * (count - 1) / (kept - 1) : 0]));
  return list;
}

const char* style_of(ChartMark mark) {
  return mark == ChartMark::points ? "points" : mark == ChartMark::dashed ? "dashed" : "line";
}

Json axis_json(const ChartAxis& axis) {
  return {{"title", axis.title}, {"log", axis.scale == AxisScale::logarithmic}};
}

}  // namespace

Json chart_json(const std::string& id, const Chart& chart, bool square) {
  Json json = {{"id", id}, {"title", chart.title}, {"x", axis_json(chart.x)}, {"y", axis_json(chart.y)}};
  json["series"] = Json::array();
  for (const ChartSeries& series : chart.series) {
    const bool thin = series.mark != ChartMark::points;
    json["series"].push_back({{"name", series.label},
                              {"x", thinned(series.x, thin)},
                              {"y", thinned(series.y, thin)},
                              {"style", style_of(series.mark)}});
  }
  for (const ChartBand& band : chart.bands)
    for (const auto* end : {&band.low, &band.high})
      json["series"].push_back({{"name", fmt::format("{}, {} end", band.label, end == &band.low ? "lower" : "upper")},
                                {"x", thinned(band.x, true)},
                                {"y", thinned(*end, true)},
                                {"style", "dashed"}});
  json["notes"] = Json::array();
  for (const ChartNote& note : chart.notes)
    json["notes"].push_back({{"x", finite(note.x)}, {"y", finite(note.y)}, {"text", note.text}});
  json["marks"] = Json::array();
  json["square"] = square;
  return json;
}

void add_mark(Json& chart, double x, const std::string& label) {
  chart["marks"].push_back({{"x", x}, {"label", label}});
}

}  // namespace weaveform
