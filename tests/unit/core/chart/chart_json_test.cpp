// Charts as data for the scripts that draw them: nothing is lost on the way.
#include "core/chart/chart_json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/chart/chart_text.hpp"

namespace weaveform {
namespace {

TEST(ChartJson, ThinsLinesButKeepsTheirEndsAndLeavesGaps) {
  Chart chart{.title = "t"};
  ChartSeries line{.label = "a"};
  for (int k = 0; k < 10001; ++k) {
    line.x.push_back(k);
    line.y.push_back(k == 10000 ? NAN : 2.0 * k);
  }
  chart.series.push_back(line);
  const auto json = chart_json("id", chart);
  const auto& x = json["series"][0]["x"];
  EXPECT_EQ(x.size(), most_points_of_a_line);
  EXPECT_EQ(x.front(), 0.0);
  EXPECT_EQ(x.back(), 10000.0);
  EXPECT_TRUE(json["series"][0]["y"].back().is_null());
  chart.series[0].mark = ChartMark::points;
  EXPECT_EQ(chart_json("id", chart)["series"][0]["x"].size(), 10001U) << "a cloud has no order to thin by";
}

TEST(ChartJson, KeepsAllThatAChartCanSay) {
  Chart chart{.title = "t", .x = {.title = "x", .from = 1.0}, .y = {.scale = AxisScale::logarithmic, .to = 9.0}};
  chart.bands.push_back({.label = "border", .x = {1.0, 2.0}, .low = {3.0, 4.0}, .high = {5.0, 6.0}, .colour = 3});
  chart.series.push_back({.label = "s",
                          .x = {1, 2},
                          .y = {3, 4},
                          .mark = ChartMark::points,
                          .colour = 2,
                          .y_low = {2.5, NAN},
                          .y_high = {3.5},
                          .shape = 4});
  chart.series.push_back({.x = {1, 2}, .y = {3, 4}, .mark = ChartMark::dashed});
  chart.notes.push_back({"coarsening\n4", 1.5, 4.5});
  auto json = chart_json("id", chart, true);
  add_mark(json, 2.0, "m");
  EXPECT_EQ(json, nlohmann::ordered_json::parse(R"({"id":"id","title":"t",
      "x":{"title":"x","log":false,"from":1.0},"y":{"title":"","log":true,"to":9.0},
      "series":[{"name":"s","x":[1.0,2.0],"y":[3.0,4.0],"y_low":[2.5,null],"y_high":[3.5,null],"style":"points","colour":2,"shape":4},
                {"name":"","x":[1.0,2.0],"y":[3.0,4.0],"style":"dashed"}],
      "bands":[{"name":"border","x":[1.0,2.0],"low":[3.0,4.0],"high":[5.0,6.0],"colour":3}],
      "notes":[{"x":1.5,"y":4.5,"text":"coarsening 4"}],"marks":[{"x":2.0,"label":"m"}],"square":true})"));
}

TEST(ChartText, IsOneLineOfUtf8) {
  EXPECT_EQ(chart_text("a\nb\x01"), "a b ");
  EXPECT_EQ(chart_text("\xFFü\xC0\xAF𝛾\xE2\x82"), "\xEF\xBF\xBDü\xEF\xBF\xBD\xEF\xBF\xBD𝛾\xEF\xBF\xBD\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("a < b & c > d"), "a &lt; b &amp; c &gt; d");
}

}  // namespace
}  // namespace weaveform
