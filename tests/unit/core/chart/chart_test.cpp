// Charts as they are drawn: nothing is lost or misplaced.
#include "core/chart/chart.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/core/chart/drawing.hpp"

namespace weaveform::test {
namespace {

TEST_F(DrawnChart, HoldsEveryTextOverBothKindsOfAxis) {
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
    Chart chart = some_chart();
    chart.y.scale = scale;
    chart.notes = {{"here <", 2.0, 10.0}, {"on neither scale", 2.0, nan}};
    const std::string svg = to_svg(chart);
    const Drawing drawing = seen(svg);
    for (const char* text : {"a < b & \"c\"", "x (1)", "y (MPa)", "band", "line", "points", "here <"})
      EXPECT_EQ(count_of(drawing, text), 1) << text;
    EXPECT_EQ(count_of(drawing, "on neither scale"), 0);
    EXPECT_EQ(svg.find("NaN"), std::string::npos);
    const std::set<std::string> said(drawing.titles.begin(), drawing.titles.end());
    EXPECT_EQ(said, (std::set<std::string>{"a < b & \"c\"", "band", "line", "points"}));
  }
}

TEST_F(DrawnChart, PointsLinesAndBandsLieWhereTheAxesNumbersSay) {
  for (const AxisScale x : {AxisScale::linear, AxisScale::logarithmic})
    for (const AxisScale y : {AxisScale::linear, AxisScale::logarithmic}) {
      Chart chart{.x = {.scale = x}, .y = {.scale = y}};
      const std::vector<double> xs = {0.02, 1, 37, 1e4}, ys = {5, 1e-4, 0.3, 2};
      chart.series.push_back({.label = "points", .x = xs, .y = ys, .mark = ChartMark::points});
      chart.series.push_back({.label = "line", .x = xs, .y = ys});
      chart.bands.push_back({.label = "band", .x = xs, .low = ys, .high = {7, 8, 9, 10}});
      const Drawing drawing = drawn(chart);
      const Axes axes = axes_of(drawing, chart);
      ASSERT_GE(axes.x.labels, 2);
      ASSERT_GE(axes.y.labels, 2);
      const auto marks = marks_of(drawing, "points");
      const auto line = corners_of(line_of(drawing, "line")), band = corners_of(line_of(drawing, "band"));
      ASSERT_EQ(marks.size(), 4U);
      ASSERT_EQ(line.size(), 4U);
      ASSERT_GE(band.size(), 8U);
      for (std::size_t i = 0; i < 4; ++i) {
        for (const Place& place : {marks[i], line[i], band[7 - i]}) {
          EXPECT_NEAR(place.x, axes.x(xs[i]), rounding);
          EXPECT_NEAR(place.y, axes.y(ys[i]), rounding);
        }
        EXPECT_NEAR(band[i].y, axes.y(chart.bands[0].high[i]), rounding);
      }
    }
}

TEST_F(DrawnChart, EveryTextIsOnTheCanvasAndOffTheOthers) {
  std::vector<Chart> charts;
  for (const double scale : {1e-12, 1e-7, 2e-4, 1.0, 3e6, 1e20}) {
    for (const AxisScale kind : {AxisScale::linear, AxisScale::logarithmic}) {
      Chart chart = some_chart();
      chart.y.scale = chart.x.scale = kind;
      chart.notes = {{"here", 2.0, 10.0 * scale}, {"and here", 2.01, 11.0 * scale}};
      for (ChartSeries& series : chart.series)
        for (double& y : series.y) y *= scale;
      chart.bands.clear();
      charts.push_back(chart);
      std::swap(chart.series[0].x, chart.series[0].y);
      std::swap(chart.series[1].x, chart.series[1].y);
      charts.push_back(chart);
    }
  }
  for (const std::string& svg : to_svgs(charts)) {
    const Drawing drawing = seen(svg);
    EXPECT_GT(drawing.texts.size(), 8U);
    expect_readable(drawing);
  }
}

TEST_F(DrawnChart, TextsOfAnyLengthAndNumberFit) {
  std::vector<Chart> charts;
  for (const std::size_t length : {1, 40, 90, 300, 5000}) {
    const std::string text = std::string(length, 'w');
    Chart chart{.title = text, .x = {.title = text}, .y = {.title = text}, .notes = {{text, 1.5, 1.5}}};
    chart.series.push_back({.label = text, .x = {1, 2}, .y = {1, 2}});
    chart.series.push_back({.label = text, .x = {1, 2}, .y = {2, 1}});
    charts.push_back(chart);
  }
  Chart crowd;
  for (int i = 0; i < 60; ++i)
    crowd.series.push_back({.label = "series " + std::to_string(i), .x = {1, 2}, .y = {1.0 * i, 2}});
  charts.push_back(crowd);
  const auto svgs = to_svgs(charts);
  for (const std::string& svg : svgs) expect_readable(seen(svg));
  EXPECT_EQ(count_of(seen(svgs[1]), charts[1].title), 6) << "two series of one label stay two";
  EXPECT_EQ(count_of(svgs[4], "<title>" + charts[4].title + "</title>"), 5U) << "told in full when pointed at";
  const Drawing crowded = seen(svgs.back());
  for (const auto& series : crowd.series) EXPECT_EQ(count_of(crowded, series.label), 1) << series.label;
  EXPECT_GT(crowded.height, crowd.height) << "the legend comes on top";
}

TEST_F(DrawnChart, ALimitThatWasAskedForCutsTheData) {
  Chart chart{.x = {.from = 0.0, .to = 2.0}};
  chart.series.push_back({.label = "p", .x = {1, 3}, .y = {1, 2}, .mark = ChartMark::points});
  const Drawing cut = drawn(chart);
  EXPECT_EQ(marks_of(cut, "p").size(), 1U);
  EXPECT_EQ(axes_of(cut, chart).x.from, 0.0);
  EXPECT_EQ(axes_of(cut, chart).x.to, 2.0);
  chart.x = {.from = 5.0};
  EXPECT_EQ(marks_of(drawn(chart), "p").size(), 0U) << "beyond all data";
  chart.x = {.scale = AxisScale::logarithmic, .from = -1.0};
  EXPECT_EQ(marks_of(drawn(chart), "p").size(), 2U) << "no such place on a logarithmic axis";
}

TEST_F(DrawnChart, AValueThatCannotBeDrawnInterruptsTheLine) {
  Chart chart;
  chart.series.push_back({.label = "l", .x = {1, 2, 3, 4, 5}, .y = {1, 10, 100, 1000, 10000}});
  const auto pieces = [](const Chart& one) { return count_of(line_of(drawn(one), "l"), "M"); };
  EXPECT_EQ(pieces(chart), 1U);
  for (const double value : {nan, HUGE_VAL, -HUGE_VAL}) {
    Chart broken = chart;
    broken.series[0].y[2] = value;
    EXPECT_EQ(pieces(broken), 2U) << value;
    broken = chart;
    broken.series[0].x[2] = value;
    EXPECT_EQ(pieces(broken), 2U) << "x " << value;
  }
  chart.series[0].y[2] = -1.0;
  EXPECT_EQ(pieces(chart), 1U);
  chart.y.scale = AxisScale::logarithmic;
  EXPECT_EQ(pieces(chart), 2U);
  chart.bands.push_back({.label = "b", .x = {1, 2, 3, 4, 5}, .low = {1, 1, nan, 1, 1}, .high = {2, 2, 2, 2, 2}});
  EXPECT_EQ(drawn(chart).series["b"].size(), 2U) << "a band, too";
}

TEST_F(DrawnChart, EmptyAndConstantDataStillGiveAxes) {
  Chart constant, nearly, undrawable, zero;
  constant.series.push_back({.x = {1, 2}, .y = {5, 5}});
  nearly.series.push_back({.x = {1e6, 1e6 + 1e-2}, .y = {5, 5 + 1e-8}});
  undrawable.series.push_back({.label = "nothing", .x = {1, 2}, .y = {nan, nan}});
  zero.series.push_back({.x = {0}, .y = {0}});
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic})
    for (Chart chart : {Chart{}, constant, nearly, undrawable, zero}) {
      chart.x.scale = chart.y.scale = scale;
      const Drawing drawing = drawn(chart);
      const Axes axes = axes_of(drawing, chart);
      EXPECT_GE(axes.x.labels, 2);
      EXPECT_GE(axes.y.labels, 2);
      EXPECT_LT(axes.x.from, axes.x.to) << "labels tell their values apart";
      EXPECT_EQ(count_of(drawing, "nothing") == 1, !chart.series.empty() && !chart.series[0].label.empty());
      expect_readable(drawing);
    }
}

TEST_F(DrawnChart, ALogarithmicAxisIsReadableOverAnySpan) {
  std::vector<Chart> charts;
  for (const double from : {1e-12, 3e-3, 0.7, 1.0, 9.4, 2e7})
    for (const double span : {1.02, 1.5, 3.0, 9.0, 30.0, 1e3, 1e5, 1e9, 1e20}) {
      Chart chart{.x = {.scale = AxisScale::logarithmic}, .y = {.scale = AxisScale::logarithmic}};
      chart.series.push_back({.label = "l", .x = {from, from * span}, .y = {from, from * span}});
      charts.push_back(chart);
    }
  const auto svgs = to_svgs(charts);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const Drawing drawing = seen(svgs[i]);
    const Axes axes = axes_of(drawing, charts[i]);
    const auto& x = charts[i].series[0].x;
    for (const Axis& axis : {axes.x, axes.y}) {
      EXPECT_GE(axis.labels, 2) << x[0] << " to " << x[1];
      EXPECT_LE(axis.labels, 14) << x[0] << " to " << x[1];
    }
    const auto line = corners_of(line_of(drawing, "l"));
    ASSERT_EQ(line.size(), 2U);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(line[k].x, axes.x(x[k]), rounding) << x[0] << " to " << x[1];
    expect_readable(drawing);
  }
}

TEST_F(DrawnChart, ErrorBarsReachFromLowToHigh) {
  Chart chart{.y = {.scale = AxisScale::logarithmic}};
  chart.series.push_back({.label = "e",
                          .x = {1, 2, 3},
                          .y = {1, 10, 100},
                          .mark = ChartMark::points,
                          .y_low = {0.5, -1.0, nan},
                          .y_high = {2, 20, nan}});
  const Drawing drawing = drawn(chart);
  const Axes axes = axes_of(drawing, chart);
  EXPECT_EQ(marks_of(drawing, "e").size(), 3U);
  std::vector<std::pair<Place, Place>> bars;  // upright lines, lower end first
  for (const Shape& shape : drawing.series.at("e")) {
    const auto ends = corners_of(shape.path);
    if (shape.transform.empty() && ends.size() == 2 && std::abs(ends[0].x - ends[1].x) < rounding)
      bars.emplace_back(ends[0], ends[1]);
  }
  ASSERT_EQ(bars.size(), 2U) << "none where there is no number";
  const double low[] = {0.5, axes.y.from}, high[] = {2.0, 20.0};  // the second down to the end of the axis
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(bars[i].first.x, axes.x(chart.series[0].x[i]), 0.6);  // lines of one pixel lie on whole pixels
    EXPECT_NEAR(bars[i].first.y, axes.y(low[i]), 0.6);
    EXPECT_NEAR(bars[i].second.y, axes.y(high[i]), 0.6);
  }
  EXPECT_EQ(count_of(drawing, "e"), 1) << "one entry in the legend";
}

TEST_F(DrawnChart, GroupsDifferInColourAndShape) {
  Chart chart;
  for (int i = 0; i < 24; ++i)
    chart.series.push_back({.label = std::to_string(i) + "th", .x = {1.0 * i}, .y = {1.0}, .mark = ChartMark::points});
  const Drawing drawing = drawn(chart);
  std::set<std::string> styles;
  for (const auto& [label, shapes] : drawing.series) styles.insert(shapes[0].path + shapes[0].fill + shapes[0].stroke);
  EXPECT_EQ(styles.size(), 24U);
  chart.series[3].colour = chart.series[5].colour = 2;
  chart.series[3].shape = chart.series[5].shape = 1;
  const Drawing alike = drawn(chart);
  EXPECT_EQ(alike.series.at("3th")[0].path, alike.series.at("5th")[0].path);
  EXPECT_EQ(alike.series.at("3th")[0].fill, alike.series.at("5th")[0].fill);
}

TEST_F(DrawnChart, TheSameChartGivesTheSameBytesWhateverTheUserHasSetOrWasDrawnBefore) {
  const std::string first = to_svg(some_chart());
  Chart other = some_chart();
  other.series.resize(1);
  EXPECT_EQ(to_svgs({other, some_chart()})[1], first);
  setenv("NODE_OPTIONS", "--require=/nowhere.js", 1);
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  EXPECT_EQ(to_svg(some_chart()), first);
  unsetenv("LC_ALL");
  unsetenv("NODE_OPTIONS");
}

TEST_F(DrawnChart, ManyPointsPassThrough) {
  Chart chart;
  chart.series.push_back({.label = "p", .mark = ChartMark::points});
  chart.series.push_back({.label = "l"});
  for (int i = 0; i < 60000; ++i) {
    for (ChartSeries& series : chart.series) {
      series.x.push_back(i);
      series.y.push_back(std::sin(i));
    }
  }
  const Drawing drawing = drawn(chart);
  EXPECT_EQ(marks_of(drawing, "p").size(), 60000U);
  EXPECT_GT(corners_of(line_of(drawing, "l")).size(), 30000U) << "no peak is thinned away";
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

// Of unstable runs: every line runs from far below the plot to far above.
TEST_F(DrawnChart, WildDataStayOnTheCanvas) {
  Chart chart;
  chart.y.to = 1.0;
  chart.series.push_back({.label = "l"});
  for (int i = 0; i < 5000; ++i) {
    chart.series[0].x.push_back(i);
    chart.series[0].y.push_back(i % 2 == 0 ? 1.7e308 : i % 3 == 0 ? -1.7e308 : i);
  }
  for (const std::optional<double> from : {std::optional<double>{}, std::optional<double>{0.0}}) {
    chart.y.from = from;
    const Drawing drawing = drawn(chart);
    EXPECT_TRUE(drawing.well_formed);
    EXPECT_GE(axes_of(drawing, chart).y.labels, 2);
  }
}

TEST_F(DrawnChart, NotesStayInThePlotAndOffEachOther) {
  Chart chart{.x = {.scale = AxisScale::logarithmic}, .y = {.scale = AxisScale::logarithmic}};
  ChartSeries front{.label = "front", .mark = ChartMark::points};
  const std::string words = "blank.coarsening=2 model.cell=shell";
  for (const double x : {0.01, 0.011, 0.1, 0.12, 3.0, 100.0}) {
    front.x.push_back(x);
    front.y.push_back(1.0 / x);
    chart.notes.push_back({words, x, 1.0 / x});
  }
  chart.series = {front};
  const Drawing drawing = drawn(chart);
  EXPECT_EQ(count_of(drawing, words), 6);
  expect_readable(drawing);
  const Axes axes = axes_of(drawing, chart);
  for (const Text& text : drawing.texts) {
    if (text.words != words) continue;
    const Box box = box_of(text);
    EXPECT_GE(box.left, axes.x.begin);
    EXPECT_LE(box.right, axes.x.end);
    EXPECT_GE(box.top, axes.y.end - 1.0);
    EXPECT_LE(box.bottom, axes.y.begin + 1.0);
  }
}

TEST_F(DrawnChart, ANoteStandsOffTheLineWhereThereIsRoom) {
  Chart chart;
  chart.series.push_back({.label = "rising", .x = {0, 100}, .y = {0, 100}});
  chart.notes = {{"a note of some length", 50, 50}};
  const Drawing drawing = drawn(chart);
  const Axes axes = axes_of(drawing, chart);
  for (const Text& text : drawing.texts) {
    if (text.words != chart.notes[0].text) continue;
    const Box box = box_of(text);
    for (double value = 0.0; value <= 100.0; value += 0.1) {
      const Place place{axes.x(value), axes.y(value)};
      EXPECT_FALSE(place.x > box.left && place.x < box.right && place.y > box.top && place.y < box.bottom) << value;
    }
  }
}

}  // namespace
}  // namespace weaveform::test
