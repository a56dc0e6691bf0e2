// A chart's SVG as its reader sees it: texts with their places, series with their shapes, axes as their numbers say them.
#pragma once

#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"

namespace weaveform::test {

// Charts are drawn by node, which may be missing.
class DrawnChart : public testing::Test {
protected:
  void SetUp() override {
    if (std::system("node --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs node";
  }
};

inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

inline std::string attribute(vtkXMLDataElement* element, const char* name) {
  const char* value = element->GetAttribute(name);
  return value != nullptr ? value : "";
}

inline std::string content(vtkXMLDataElement* element) {
  const char* text = element->GetCharacterData();
  return text != nullptr ? text : "";
}

inline Text text_of(vtkXMLDataElement* element) {
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

inline void look_into(vtkXMLDataElement* element, const std::string& series, Drawing& drawing) {
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

inline Drawing seen(const std::string& svg) {
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

inline Drawing drawn(const Chart& chart) {
  return seen(to_svg(chart));
}

inline std::ptrdiff_t count_of(const Drawing& drawing, const std::string& words) {
  return std::count_if(drawing.texts.begin(), drawing.texts.end(),
                       [&](const Text& text) { return text.words == words; });
}

inline std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// What a tick says; NaN when it is no number.
inline double number_of(std::string words) {
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

inline Axis axis_of(const Drawing& drawing, char which, AxisScale scale) {
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
inline Axes axes_of(const Drawing& drawing, const Chart& chart) {
  return {axis_of(drawing, 'x', chart.x.scale), axis_of(drawing, 'y', chart.y.scale)};
}

// The marks of series drawn as points, in the order drawn.
inline std::vector<Place> marks_of(const Drawing& drawing, const std::string& label) {
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
inline std::vector<Place> corners_of(const std::string& path) {
  std::string numbers = path;
  for (char& c : numbers)
    if (c == 'M' || c == 'L' || c == 'Z') c = ' ';
  std::istringstream words(numbers);
  std::vector<Place> corners;
  for (Place place; words >> place.x >> place.y;) corners.push_back(place);
  return corners;
}

// The longest path of a series: its line.
inline std::string line_of(const Drawing& drawing, const std::string& label) {
  std::string longest;
  const auto found = drawing.series.find(label);
  if (found == drawing.series.end()) return longest;
  for (const Shape& shape : found->second)
    if (shape.transform.empty() && shape.path.size() > longest.size()) longest = shape.path;
  return longest;
}

inline Chart some_chart() {
  Chart chart{.title = "a < b & \"c\"", .x = {.title = "x (1)"}, .y = {.title = "y (MPa)"}};
  chart.bands.push_back({.label = "band", .x = {1, 2, 3}, .low = {1, 2, 3}, .high = {2, 3, 4}});
  chart.series.push_back({.label = "line", .x = {1, 2, 3, 4, 5}, .y = {1, 10, 100, 1000, 10000}});
  chart.series.push_back({.label = "points", .x = {1, 2}, .y = {3, 4}, .mark = ChartMark::points});
  return chart;
}

// 0.1 px: the SVG's rounding of lines, and of the numbers that an axis shows.
inline constexpr double rounding = 0.11;

// In a sans-serif font of average width.
inline double width_of(const Text& text) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  return 0.55 * text.size * static_cast<double>(std::count_if(text.words.begin(), text.words.end(), [&](char c) {
           return !continues(c);
         }));
}

struct Box {
  double left, top, right, bottom;
};
inline Box box_of(const Text& text) {
  const double width = width_of(text), half = 0.5 * text.size;
  const double before = text.anchor == "start" ? 0.0 : text.anchor == "end" ? width : 0.5 * width;
  if (text.turned) return {text.at.x - half, text.at.y + before - width, text.at.x + half, text.at.y + before};
  return {text.at.x - before, text.at.y - half, text.at.x - before + width, text.at.y + half};
}

inline void expect_readable(const Drawing& drawing) {
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

}  // namespace weaveform::test
