// Charts as they are drawn: nothing is lost, misplaced or executed.
#include "core/chart/chart.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "solver/result/chart_file.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Charts are drawn by node, which may be missing.
class DrawnChart : public testing::Test {
protected:
  void SetUp() override {
    if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs node";
  }
};
using DrawnText = DrawnChart;
using DrawnPage = DrawnChart;
using ChartFile = DrawnChart;

// ---- an SVG as its reader sees it

struct Place {
  double x = 0.0, y = 0.0;  // px
};

struct Text {
  std::string words, anchor;
  Place at;
  double size = 0.0;  // px
  bool turned = false;
};

struct Shape {
  std::string path, transform, fill, stroke;
};

struct Drawing {
  bool well_formed = false;
  double width = 0.0, height = 0.0;
  std::vector<std::string> titles;
  std::vector<Text> texts;
  std::map<std::string, std::vector<Shape>> series;  // by what is said when pointed at
};

std::string attribute(vtkXMLDataElement* element, const char* name) {
  const char* value = element->GetAttribute(name);
  return value != nullptr ? value : "";
}

std::string content(vtkXMLDataElement* element) {
  const char* text = element->GetCharacterData();
  return text != nullptr ? text : "";
}

Text text_of(vtkXMLDataElement* element) {
  Text text;
  text.words = content(element);
  text.anchor = attribute(element, "text-anchor");
  const std::string moved = attribute(element, "transform"), style = attribute(element, "style");
  const double right = std::strtod(attribute(element, "x").c_str(), nullptr);
  const double down = std::strtod(attribute(element, "y").c_str(), nullptr);
  Place to;
  if (std::sscanf(moved.c_str(), "matrix(0,-1,1,0,%lf,%lf)", &to.x, &to.y) == 2) {
    text.turned = true;
    text.at = {to.x + down, to.y - right};
  } else {
    if (std::sscanf(moved.c_str(), "translate(%lf %lf)", &to.x, &to.y) != 2) to = {};
    text.at = {to.x + right, to.y + down};
  }
  text.size = std::strtod(style.c_str() + std::min(style.size(), style.find("font-size:") + 10), nullptr);
  return text;
}

void look_into(vtkXMLDataElement* element, const std::string& series, Drawing& drawing) {
  const std::string name = element->GetName();
  if (name == "defs") return;
  if (name == "title") drawing.titles.push_back(content(element));
  if (name == "text") drawing.texts.push_back(text_of(element));
  if ((name == "path" || name == "polygon") && !series.empty())
    drawing.series[series].push_back({attribute(element, name == "path" ? "d" : "points"),
                                      attribute(element, "transform"), attribute(element, "fill"),
                                      attribute(element, "stroke")});
  std::string own = series;
  if (auto* title = element->FindNestedElementWithName("title"); title != nullptr && name == "g") own = content(title);
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) look_into(element->GetNestedElement(i), own, drawing);
}

Drawing seen(const std::string& svg) {
  Drawing drawing;
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromString(svg.substr(svg.find("<svg")).c_str()));
  if (!root) return drawing;
  drawing.well_formed = true;
  drawing.width = std::strtod(attribute(root, "width").c_str(), nullptr);
  drawing.height = std::strtod(attribute(root, "height").c_str(), nullptr);
  look_into(root, "", drawing);
  return drawing;
}

Drawing drawn(const Chart& chart) {
  return seen(to_svg(chart));
}

std::ptrdiff_t count_of(const Drawing& drawing, const std::string& words) {
  return std::count_if(drawing.texts.begin(), drawing.texts.end(),
                       [&](const Text& text) { return text.words == words; });
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// What a tick says; NaN when it is no number.
double number_of(std::string words) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (auto at = words.find(from); at != std::string::npos; at = words.find(from)) words.replace(at, from.size(), to);
  };
  const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const bool power = std::any_of(std::begin(digits), std::end(digits),
                                 [&](const char* digit) { return words.find(digit) != std::string::npos; });
  for (int digit = 0; digit < 10; ++digit) replace(digits[digit], std::to_string(digit));
  replace("⁻", "-");
  replace("−", "-");
  if (power) {
    replace("×10", "e");
    if (words.find('e') == std::string::npos) words = "1e" + words.substr(2);
  }
  char* end = nullptr;
  const double value = std::strtod(words.c_str(), &end);
  return words.empty() || *end != '\0' ? nan : value;
}

// An axis as its numbers say it: the first and the last of them.
struct Axis {
  double from = nan, to = nan, begin = 0.0, end = 0.0;  // values; px
  int labels = 0;
  bool log = false;
  [[nodiscard]] double operator()(double value) const {
    const auto part = log ? std::log(value / from) / std::log(to / from) : (value - from) / (to - from);
    return begin + part * (end - begin);
  }
};

Axis axis_of(const Drawing& drawing, char which, AxisScale scale) {
  Axis axis{.log = scale == AxisScale::logarithmic};
  double bottom = 0.0;  // where the x axis has its numbers
  for (const Text& text : drawing.texts)
    if (text.anchor == "middle" && !std::isnan(number_of(text.words))) bottom = std::max(bottom, text.at.y);
  for (const Text& text : drawing.texts) {
    const double value = number_of(text.words);
    if (std::isnan(value) || text.turned) continue;
    if (which == 'x' ? text.anchor != "middle" || text.at.y < bottom - 1.0 : text.anchor != "end") continue;
    const double place = which == 'x' ? text.at.x : text.at.y;
    ++axis.labels;
    if (std::isnan(axis.from) || value < axis.from) {
      axis.from = value;
      axis.begin = place;
    }
    if (std::isnan(axis.to) || value > axis.to) {
      axis.to = value;
      axis.end = place;
    }
  }
  return axis;
}

struct Axes {
  Axis x, y;
};
Axes axes_of(const Drawing& drawing, const Chart& chart) {
  return {axis_of(drawing, 'x', chart.x.scale), axis_of(drawing, 'y', chart.y.scale)};
}

// The marks of series drawn as points, in the order drawn.
std::vector<Place> marks_of(const Drawing& drawing, const std::string& label) {
  std::vector<Place> marks;
  const auto found = drawing.series.find(label);
  if (found == drawing.series.end()) return marks;
  for (const Shape& shape : found->second) {
    Place place;
    double across = 0.0, down = 0.0;
    if (std::sscanf(shape.transform.c_str(), "matrix(%lf,0,0,%lf,%lf,%lf)", &across, &down, &place.x, &place.y) == 4)
      marks.push_back(place);
  }
  return marks;
}

// Corners of a path of moves and lines.
std::vector<Place> corners_of(const std::string& path) {
  std::string numbers = path;
  for (char& c : numbers)
    if (c == 'M' || c == 'L' || c == 'Z') c = ' ';
  std::istringstream words(numbers);
  std::vector<Place> corners;
  for (Place place; words >> place.x >> place.y;) corners.push_back(place);
  return corners;
}

// The longest path of a series: its line.
std::string line_of(const Drawing& drawing, const std::string& label) {
  std::string longest;
  const auto found = drawing.series.find(label);
  if (found == drawing.series.end()) return longest;
  for (const Shape& shape : found->second)
    if (shape.transform.empty() && shape.path.size() > longest.size()) longest = shape.path;
  return longest;
}

Chart some_chart() {
  Chart chart{.title = "a < b & \"c\"", .x = {.title = "x (1)"}, .y = {.title = "y (MPa)"}};
  chart.bands.push_back({.label = "band", .x = {1, 2, 3}, .low = {1, 2, 3}, .high = {2, 3, 4}});
  chart.series.push_back({.label = "line", .x = {1, 2, 3, 4, 5}, .y = {1, 10, 100, 1000, 10000}});
  chart.series.push_back({.label = "points", .x = {1, 2}, .y = {3, 4}, .mark = ChartMark::points});
  return chart;
}

// 0.1 px: the SVG's rounding of lines, and of the numbers that an axis shows.
constexpr double rounding = 0.11;

// ---- data

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

// In a sans-serif font of average width.
double width_of(const Text& text) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  return 0.55 * text.size * static_cast<double>(std::count_if(text.words.begin(), text.words.end(), [&](char c) {
           return !continues(c);
         }));
}

struct Box {
  double left, top, right, bottom;
};
Box box_of(const Text& text) {
  const double width = width_of(text), half = 0.5 * text.size;
  const double before = text.anchor == "start" ? 0.0 : text.anchor == "end" ? width : 0.5 * width;
  if (text.turned) return {text.at.x - half, text.at.y + before - width, text.at.x + half, text.at.y + before};
  return {text.at.x - before, text.at.y - half, text.at.x - before + width, text.at.y + half};
}

void expect_readable(const Drawing& drawing) {
  ASSERT_TRUE(drawing.well_formed);
  for (std::size_t i = 0; i < drawing.texts.size(); ++i) {
    const Box one = box_of(drawing.texts[i]);
    EXPECT_GE(one.left, -1.0) << drawing.texts[i].words;
    EXPECT_GE(one.top, -1.0) << drawing.texts[i].words;
    EXPECT_LE(one.right, drawing.width + 1.0) << drawing.texts[i].words;
    EXPECT_LE(one.bottom, drawing.height + 1.0) << drawing.texts[i].words;
    for (std::size_t k = 0; k < i; ++k) {
      const Box other = box_of(drawing.texts[k]);
      const bool meet = one.left < other.right - 1.0 && other.left < one.right - 1.0 && one.top < other.bottom - 1.0 &&
                        other.top < one.bottom - 1.0;
      EXPECT_FALSE(meet) << drawing.texts[i].words << " lies on " << drawing.texts[k].words;
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

// ---- texts

TEST_F(DrawnText, IsNeverACommandOrMarkup) {
  const test::TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  for (const std::string text :
       {R"("; require('fs').writeFileSync('x',''); ")", "</text><script>alert(1)</script>", "`touch x`", "${1+1}",
        "' onclick='alert(1)", "]]></svg>", "{a|b} {b} {@x}", "&lt;&amp;", "<touch x", "\\u003c\\", "__proto__",
        "clip-path=\"url(#zr0-c0)\" ecmeta_series=\"0\"", "\xFF\xC0\xAF ü \x01 𝛾", "\xE2\x80\xA8 line \xE2\x80\xA9"}) {
    Chart chart{.title = text, .x = {.title = text}, .y = {.title = text}, .notes = {{text, 1.0, 1.0}}};
    chart.bands.push_back({.label = text, .x = {1, 2}, .low = {1, 1}, .high = {2, 2}});
    chart.series.push_back({.label = text, .x = {1, 2}, .y = {1, 2}});
    std::string shown;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool invalid = text[i] == '\xFF' || text[i] == '\xC0' || (text[i] == '\xAF' && text[0] == '\xFF');
      shown += invalid ? "\xEF\xBF\xBD" : std::string(1, text[i] >= 0 && text[i] < ' ' ? ' ' : text[i]);
    }
    const std::string svg = to_svg(chart);
    const Drawing drawing = seen(svg);
    ASSERT_TRUE(drawing.well_formed) << text;
    // The parser drops blanks at the ends.
    const auto trimmed = [](std::string s) {
      s.erase(0, std::min(s.find_first_not_of(' '), s.size()));
      s.erase(s.find_last_not_of(' ') + 1);
      return s;
    };
    const auto same = [&](const Text& one) { return trimmed(one.words) == trimmed(shown); };
    EXPECT_EQ(std::count_if(drawing.texts.begin(), drawing.texts.end(), same), 6) << text << "\n" << svg;
    EXPECT_EQ(svg.find("<script"), std::string::npos);
    EXPECT_TRUE(fs::is_empty(folder.path())) << text;
  }
  fs::current_path(before);
}

// ---- a page

TEST_F(DrawnPage, HasEachChartWithItsOwnIdsAndNoScript) {
  Chart second = some_chart();
  second.caption = "What <it> shows";
  second.series[0].label = "id='c0' url(#zr0-c0)";
  const std::string page = to_html("Charts & more", {some_chart(), second});
  std::set<std::string> ids;
  std::size_t count = 0;
  for (auto at = page.find(" id=\""); at != std::string::npos; at = page.find(" id=\"", at + 1)) {
    ids.insert(page.substr(at + 5, page.find('"', at + 5) - at - 5));
    ++count;
  }
  EXPECT_EQ(ids.size(), count) << "an id of one chart is another's, too";
  std::size_t references = 0;
  for (auto at = page.find("\"url(#"); at != std::string::npos; at = page.find("\"url(#", at + 1)) {
    const std::string id = page.substr(at + 6, page.find(')', at) - at - 6);
    EXPECT_TRUE(ids.contains(id)) << id;
    ++references;
  }
  EXPECT_GE(references, 4U);
  EXPECT_EQ(count_of(page, "<svg"), 2U);
  EXPECT_NE(page.find("What &lt;it&gt; shows"), std::string::npos);
  EXPECT_NE(page.find(">id=&#39;c0&#39; url(#zr0-c0)<"), std::string::npos) << "texts are left as they are";
  for (const char* unwanted : {"<script", "onmouse", "<?xml", "<image", "<style><"})
    EXPECT_EQ(page.find(unwanted), std::string::npos) << unwanted;
}

// ---- node itself

// The PATH of this process, for the time being.
class Path {
public:
  explicit Path(const std::string& path) : before_(std::getenv("PATH")) { setenv("PATH", path.c_str(), 1); }
  ~Path() { setenv("PATH", before_.c_str(), 1); }
  Path(const Path&) = delete;
  Path& operator=(const Path&) = delete;

private:
  std::string before_;
};

std::string chart_complaint() {
  try {
    (void)to_svg(some_chart());
  } catch (const FileError& error) {
    return error.what();
  }
  return "no complaint";
}

// What draw says with this script in the place of node.
std::string complaint_with(const std::string& script) {
  const test::TemporaryFolder folder;
  test::write_text("#!/bin/sh\n" + script + "\n", folder.path() / "node");
  fs::permissions(folder.path() / "node", fs::perms::owner_all);
  const Path instead(folder.path().string());
  return chart_complaint();
}

TEST(ChartWithoutNode, NamesThePackage) {
  const Path nowhere("/nowhere");
  EXPECT_NE(chart_complaint().find("nodejs"), std::string::npos) << chart_complaint();
}

TEST(ChartWithoutNode, ANodeThatFailsIsToldWithItsReason) {
  EXPECT_EQ(complaint_with("echo 'no such thing' >&2; exit 7"),
            "charts cannot be drawn: node (package nodejs, 18 or later) ended with exit code 7: no such thing");
  EXPECT_NE(complaint_with("kill -9 $$").find("signal 9"), std::string::npos);
  for (const char* other : {"echo hello", "echo '[]'", "echo '[1]'", "exit 0"})
    EXPECT_NE(complaint_with(other).find("does not write"), std::string::npos) << other;
}

TEST_F(ChartFile, WithoutNodeAnOlderChartGoesAndTheReasonIsSaidOnce) {
  const test::TemporaryFolder folder;
  const fs::path one = folder.path() / "one.svg", other = folder.path() / "other.svg";
  write_charts({{one, some_chart()}, {other, some_chart()}});
  EXPECT_TRUE(seen(test::read_text(one)).well_formed);
  EXPECT_EQ(test::read_text(one), test::read_text(other));
  const Path nowhere("/nowhere");
  std::vector<std::string> said;
  hear_of_missing_charts([&](const std::string& reason) { said.push_back(reason); });
  write_chart(one, some_chart());
  write_charts({{other, some_chart()}});
  hear_of_missing_charts({});
  EXPECT_FALSE(fs::exists(one));
  EXPECT_FALSE(fs::exists(other));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said.front().find("nodejs"), std::string::npos) << said.front();
}

}  // namespace
}  // namespace weaveform
