// Charts: round ticks, well-formed SVG, axes of both kinds.
#include "mesher/base/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <regex>

namespace weaveform {
namespace {

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// Every tag is closed in the order of opening.
bool well_formed(const std::string& svg) {
  static const std::regex tag(R"(<(/?)([a-zA-Z]+)[^<>]*?(/?)>)");
  std::vector<std::string> open;
  for (std::sregex_iterator at(svg.begin(), svg.end(), tag), end; at != end; ++at) {
    if ((*at)[1].length() > 0) {
      if (open.empty() || open.back() != (*at)[2].str()) return false;
      open.pop_back();
    } else if ((*at)[3].length() == 0) {
      open.push_back((*at)[2].str());
    }
  }
  return open.empty();
}

TEST(ChartTicks, AreRoundAndWithin) {
  EXPECT_EQ(chart_ticks(0.0, 50.0, AxisScale::linear), (std::vector<double>{0, 10, 20, 30, 40, 50}));
  EXPECT_EQ(chart_ticks(-1.0, 1.0, AxisScale::linear, 4), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(chart_ticks(1.0, 100.0, AxisScale::logarithmic), (std::vector<double>{1, 2, 5, 10, 20, 50, 100}));
  const auto wide = chart_ticks(1e-6, 1.0, AxisScale::logarithmic);
  EXPECT_EQ(wide.size(), 7u) << "powers of ten alone";
}

Chart some_chart() {
  Chart chart{.title = "a < b & \"c\"", .x = {.title = "x (1)"}, .y = {.title = "y (MPa)"}};
  chart.bands.push_back({.label = "band", .x = {1, 2, 3}, .low = {1, 2, 3}, .high = {2, 3, 4}});
  chart.series.push_back({.label = "line", .x = {1, 2, 3, 4, 5}, .y = {1, 10, 100, 1000, 10000}});
  chart.series.push_back({.label = "points", .x = {1, 2}, .y = {3, 4}, .mark = ChartMark::points});
  return chart;
}

TEST(Chart, IsWellFormedOverBothKindsOfAxis) {
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
    Chart chart = some_chart();
    chart.y.scale = scale;
    chart.notes = {{"here <", 2.0, 10.0}, {"on neither scale", 2.0, std::numeric_limits<double>::quiet_NaN()}};
    const std::string svg = to_svg(chart);
    EXPECT_TRUE(well_formed(svg)) << svg;
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
    EXPECT_EQ(svg.find("neither"), std::string::npos);
    for (const char* label : {">band<", ">line<", ">points<", ">here &lt;<"}) EXPECT_EQ(count_of(svg, label), 1u);
  }
}

TEST(Chart, AValueThatCannotBeDrawnInterruptsTheLine) {
  Chart chart = some_chart();
  chart.series[0].y[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(count_of(to_svg(chart), "<polyline"), 2u);
  chart.series[0].y[2] = -1.0;
  chart.y.scale = AxisScale::logarithmic;
  EXPECT_EQ(count_of(to_svg(chart), "<polyline"), 2u);
}

TEST(Chart, EmptyAndConstantDataStillGiveAxes) {
  EXPECT_TRUE(well_formed(to_svg(Chart{})));
  Chart constant;
  constant.series.push_back({.x = {1, 2}, .y = {5, 5}});
  const std::string svg = to_svg(constant);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

}  // namespace
}  // namespace weaveform
