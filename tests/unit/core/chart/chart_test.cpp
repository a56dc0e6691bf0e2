// Charts as gnuplot draws them: nothing is lost, misplaced or executed.
#include "core/chart/chart.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>
#include <set>

#include "core/chart/chart_layout.hpp"
#include "core/chart/chart_script.hpp"
#include "core/chart/chart_ticks.hpp"
#include "core/chart/gnuplot.hpp"
#include "core/error.hpp"
#include "solver/result/chart_file.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// An SVG as an XML parser sees it; null when it is not well-formed.
vtkSmartPointer<vtkXMLDataElement> parsed(const std::string& svg) {
  return vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromString(svg.c_str()));
}

void visit(vtkXMLDataElement* element, const std::function<void(vtkXMLDataElement*)>& look) {
  look(element);
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) visit(element->GetNestedElement(i), look);
}

std::vector<std::string> contents_of(const std::string& svg, const std::string& tag) {
  std::vector<std::string> found;
  const auto root = parsed(svg);
  if (!root) return {"not well-formed: " + svg};
  visit(root, [&](vtkXMLDataElement* element) {
    if (element->GetName() != tag) return;
    const char* text = element->GetCharacterData();
    found.emplace_back(text != nullptr ? text : "");
  });
  return found;
}

bool holds(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

struct Place {
  double x, y;
};

// The marks of series drawn as points, in the order drawn.
std::vector<Place> marks_of(const std::string& svg) {
  std::vector<Place> marks;
  visit(parsed(svg), [&](vtkXMLDataElement* element) {
    const char* moved = element->GetAttribute("transform");
    Place place{};
    if (std::string(element->GetName()) == "use" && moved != nullptr &&
        std::sscanf(moved, "translate(%lf,%lf) scale", &place.x, &place.y) == 2)
      marks.push_back(place);
  });
  return marks;
}

Chart some_chart() {
  Chart chart{.title = "a < b & \"c\"", .x = {.title = "x (1)"}, .y = {.title = "y (MPa)"}};
  chart.bands.push_back({.label = "band", .x = {1, 2, 3}, .low = {1, 2, 3}, .high = {2, 3, 4}});
  chart.series.push_back({.label = "line", .x = {1, 2, 3, 4, 5}, .y = {1, 10, 100, 1000, 10000}});
  chart.series.push_back({.label = "points", .x = {1, 2}, .y = {3, 4}, .mark = ChartMark::points});
  return chart;
}

TEST(Chart, HoldsEveryTextOverBothKindsOfAxis) {
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
    Chart chart = some_chart();
    chart.y.scale = scale;
    chart.notes = {{"here <", 2.0, 10.0}, {"on neither scale", 2.0, nan}};
    const std::string svg = to_svg(chart);
    const auto texts = contents_of(svg, "text");
    for (const char* text : {"a < b & \"c\"", "x (1)", "y (MPa)", "band", "line", "points", "here <"})
      EXPECT_EQ(std::count(texts.begin(), texts.end(), text), 1) << text;
    EXPECT_FALSE(holds(texts, "on neither scale"));
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    // What a viewer shows beside the pointer.
    EXPECT_EQ(contents_of(svg, "title"), (std::vector<std::string>{"a < b & \"c\"", "band", "line", "points"}));
  }
}

// The layout knows where gnuplot puts a value: legend and notes rely on it. 0.1 px: gnuplot's own rounding.
TEST(Chart, PointsLieWhereTheLayoutHasThemInsideThePlot) {
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic}) {
    Chart chart{.x = {.scale = scale}, .y = {.scale = scale}};
    chart.series.push_back({.x = {0.02, 1, 37, 1e4}, .y = {5, 1e-4, 0.3, 2}, .mark = ChartMark::points});
    const ChartLayout layout = layout_of(chart);
    const auto marks = marks_of(to_svg(chart));
    ASSERT_EQ(marks.size(), 4U);
    for (std::size_t i = 0; i < marks.size(); ++i) {
      EXPECT_NEAR(marks[i].x, layout.x(chart.series[0].x[i]), 0.1);
      EXPECT_NEAR(marks[i].y, layout.y(chart.series[0].y[i]), 0.1);
      EXPECT_GE(marks[i].x, layout.plot.left - 0.1);
      EXPECT_LE(marks[i].x, layout.plot.right + 0.1);
      EXPECT_GE(marks[i].y, layout.plot.top - 0.1);
      EXPECT_LE(marks[i].y, layout.plot.bottom + 0.1);
    }
  }
}

TEST(Chart, EveryTextIsOnTheCanvas) {
  for (const double scale : {1e-7, 2e-4, 1.0, 3e6}) {
    for (const AxisScale kind : {AxisScale::linear, AxisScale::logarithmic}) {
      Chart chart = some_chart();
      chart.y.scale = kind;
      for (double& y : chart.series[0].y) y *= scale;
      for (double& y : chart.series[1].y) y *= scale;
      chart.bands.clear();
      const ChartLayout layout = layout_of(chart);
      std::size_t texts = 0;
      visit(parsed(to_svg(chart)), [&](vtkXMLDataElement* element) {
        if (element->FindNestedElementWithName("text") == nullptr) return;
        Place at{};
        ASSERT_EQ(std::sscanf(element->GetAttribute("transform"), "translate(%lf,%lf)", &at.x, &at.y), 2);
        const std::string words = element->FindNestedElementWithName("text")->GetCharacterData();
        const std::string anchor = element->GetAttribute("text-anchor");
        const double width = text_width(words, chart_font);
        const bool turned = std::string(element->GetAttribute("transform")).find("rotate") != std::string::npos;
        const double before = turned || anchor == "start" ? 0.0 : anchor == "end" ? width : 0.5 * width;
        EXPECT_GE(at.x - before, turned ? chart_font : 0.0) << words;
        EXPECT_LE(at.x - before + (turned ? 0.0 : width), layout.width) << words;
        EXPECT_LE(at.y, layout.height - 0.25 * chart_font) << words;
        ++texts;
      });
      EXPECT_GT(texts, 8U);
    }
  }
}

TEST(Chart, ALimitThatWasAskedForCutsTheData) {
  Chart chart{.x = {.from = 0.0, .to = 2.0}};
  chart.series.push_back({.x = {1, 3}, .y = {1, 2}, .mark = ChartMark::points});
  EXPECT_EQ(marks_of(to_svg(chart)).size(), 1U);
  chart.x = {.from = 5.0};
  EXPECT_EQ(marks_of(to_svg(chart)).size(), 0U) << "beyond all data";
  chart.x = {.scale = AxisScale::logarithmic, .from = -1.0};
  EXPECT_EQ(marks_of(to_svg(chart)).size(), 2U) << "no such place on a logarithmic axis";
}

// Pieces of the line: moves of the pen within the plotted path.
std::size_t pieces_of_line(const Chart& chart) {
  const std::string svg = to_svg(chart);
  const std::size_t begin = svg.find("stroke='rgb(  0, 114, 178)'");
  EXPECT_NE(begin, std::string::npos);
  return count_of(svg.substr(begin, svg.find("/>", begin) - begin), "M");
}

TEST(Chart, AValueThatCannotBeDrawnInterruptsTheLine) {
  Chart chart;
  chart.series.push_back({.x = {1, 2, 3, 4, 5}, .y = {1, 10, 100, 1000, 10000}});
  EXPECT_EQ(pieces_of_line(chart), 1U);
  for (const double value : {nan, HUGE_VAL, -HUGE_VAL}) {
    chart.series[0].y[2] = value;
    EXPECT_EQ(pieces_of_line(chart), 2U) << value;
  }
  chart.series[0].y[2] = -1.0;
  EXPECT_EQ(pieces_of_line(chart), 1U);
  chart.y.scale = AxisScale::logarithmic;
  EXPECT_EQ(pieces_of_line(chart), 2U);
}

TEST(Chart, EmptyAndConstantDataStillGiveAxes) {
  Chart constant, nearly, undrawable;
  constant.series.push_back({.x = {1, 2}, .y = {5, 5}});
  nearly.series.push_back({.x = {1e6, 1e6 + 1e-2}, .y = {5, 5 + 1e-8}});
  undrawable.series.push_back({.label = "nothing", .x = {1, 2}, .y = {nan, nan}});
  for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic})
    for (Chart chart : {Chart{}, constant, nearly, undrawable}) {
      chart.x.scale = chart.y.scale = scale;
      const auto texts = contents_of(to_svg(chart), "text");
      EXPECT_GE(texts.size(), 4U) << "ticks";
      EXPECT_EQ(holds(texts, "nothing"), !chart.series.empty() && !chart.series[0].label.empty());
    }
}

TEST(Chart, ErrorBarsReachFromLowToHigh) {
  Chart chart{.y = {.scale = AxisScale::logarithmic}};
  chart.series.push_back({.label = "e",
                          .x = {1, 2, 3},
                          .y = {1, 10, 100},
                          .mark = ChartMark::points,
                          .y_low = {0.5, -1.0, nan},
                          .y_high = {2, 20, nan}});
  const ChartLayout layout = layout_of(chart);
  const std::string svg = to_svg(chart);
  ASSERT_TRUE(parsed(svg));
  EXPECT_EQ(marks_of(svg).size(), 3U + 1U) << "and one in the legend";
  // 0.1 px: gnuplot's rounding.
  const auto has_bar = [&](double x, double low, double high) {
    for (auto at = svg.find(" L"); at != std::string::npos; at = svg.find(" L", at + 1)) {
      Place a{}, b{};
      if (std::sscanf(svg.c_str() + svg.rfind('M', at), "M%lf,%lf L%lf,%lf", &a.x, &a.y, &b.x, &b.y) == 4 &&
          std::abs(a.x - layout.x(x)) + std::abs(b.x - layout.x(x)) < 0.1 && std::abs(a.y - layout.y(low)) < 0.1 &&
          std::abs(b.y - layout.y(high)) < 0.1)
        return true;
    }
    return false;
  };
  EXPECT_TRUE(has_bar(1, 0.5, 2)) << svg;
  EXPECT_TRUE(has_bar(2, layout.y.from, 20)) << "down to the end of the axis";
  EXPECT_EQ(count_of(gnuplot_script(chart).text, "with vectors"), 1U);
  EXPECT_EQ(contents_of(svg, "title").back(), "e");
}

TEST(Chart, GroupsDifferInColourAndShape) {
  Chart chart;
  for (int i = 0; i < 24; ++i)
    chart.series.push_back({.label = std::to_string(i), .x = {1.0 * i}, .y = {1.0}, .mark = ChartMark::points});
  const std::string script = gnuplot_script(chart).text;
  std::set<std::string> styles;
  for (auto at = script.find("with points"); at != std::string::npos; at = script.find("with points", at + 1))
    styles.insert(script.substr(at, script.find(" title", at) - at));
  EXPECT_EQ(styles.size(), 24U);
}

TEST(Chart, TheSameChartGivesTheSameBytesWhateverTheUserHasSet) {
  const std::string first = to_svg(some_chart());
  const test::TemporaryFolder home;
  test::write_text("set terminal dumb\nset title 'mine'\n", home.path() / ".gnuplot");
  setenv("HOME", home.path().c_str(), 1);
  setenv("LC_ALL", "de_DE.UTF-8", 1);
  setenv("GNUTERM", "dumb", 1);
  EXPECT_EQ(to_svg(some_chart()), first);
  unsetenv("LC_ALL");
  unsetenv("GNUTERM");
}

TEST(Chart, ManyPointsPassThrough) {
  Chart chart;
  chart.series.push_back({.mark = ChartMark::points});
  for (int i = 0; i < 60000; ++i) {
    chart.series[0].x.push_back(i);
    chart.series[0].y.push_back(std::sin(i));
  }
  EXPECT_EQ(count_of(to_svg(chart), "<use xlink:href='#gpPt6' transform"), 60000U);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
}

// ---- texts

TEST(ChartText, IsNeverACommand) {
  const test::TemporaryFolder folder;
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  for (const std::string text : {R"("; system("touch x"); ")", R"('; system('touch x'); ')", "`touch x`", "$(touch x)",
                                 "\nsystem('touch x')\n", "\" \nEND\n! touch x\n", "@x \\\" ; !touch x", "<touch x",
                                 "\\", "100 % of {/:Bold a_b^c} ~x #c", "\xFF\xC0\xAF ü \x01 𝛾"}) {
    Chart chart{.title = text, .x = {.title = text}, .y = {.title = text}, .notes = {{text, 1.0, 1.0}}};
    chart.bands.push_back({.label = text, .x = {1, 2}, .low = {1, 1}, .high = {2, 2}});
    chart.series.push_back({.label = text, .x = {1, 2}, .y = {1, 2}});
    std::string shown;
    for (std::size_t i = 0; i < text.size(); ++i) {
      const bool invalid = text[i] == '\xFF' || text[i] == '\xC0' || text[i] == '\xAF';
      shown += invalid ? "\xEF\xBF\xBD" : std::string(1, text[i] >= 0 && text[i] < ' ' ? ' ' : text[i]);
    }
    const std::string svg = to_svg(chart);
    EXPECT_EQ(count_of(svg, "<text"), count_of(svg, "</text>"));
    const auto texts = contents_of(svg, "text");
    // The parser drops blanks at the ends.
    const auto same = [&](const std::string& one) {
      const auto trimmed = [](std::string s) {
        s.erase(0, std::min(s.find_first_not_of(' '), s.size()));
        s.erase(s.find_last_not_of(' ') + 1);
        return s;
      };
      return trimmed(one) == trimmed(shown);
    };
    EXPECT_EQ(std::count_if(texts.begin(), texts.end(), same), 6) << text << "\n" << svg;
    EXPECT_TRUE(parsed(svg)) << text;
    EXPECT_TRUE(fs::is_empty(folder.path())) << text;
  }
  fs::current_path(before);
}

TEST(ChartText, IsQuotedInOctalWhereGnuplotMightReadIt) {
  EXPECT_EQ(gnuplot_quoted("a b"), "\"a b\"");
  EXPECT_EQ(gnuplot_quoted("\"`@\\"), "\"\\042\\140\\100\\134\"");
  EXPECT_EQ(gnuplot_quoted("1\n2"), "\"1 2\"");
  EXPECT_EQ(gnuplot_quoted("γ°\xC3"), "\"γ°\xEF\xBF\xBD\"");
}

// ---- layout

Chart rising() {
  Chart chart;
  chart.series.push_back({.label = "rising"});
  for (int i = 0; i <= 100; ++i) {
    chart.series[0].x.push_back(i);
    chart.series[0].y.push_back(i);
  }
  return chart;
}

TEST(ChartLayout, TheLegendTakesACornerWithoutData) {
  Chart chart = rising();
  const auto upper_left = layout_of(chart);
  EXPECT_LT(upper_left.legend->left, 200.0);
  EXPECT_LT(upper_left.legend->top, 100.0);
  for (double& y : chart.series[0].y) y = 100.0 - y;
  const auto upper_right = layout_of(chart);
  EXPECT_GT(upper_right.legend->left, 300.0);
  EXPECT_LT(upper_right.legend->right, upper_right.plot.right);
  EXPECT_LT(upper_right.legend->top, 100.0);
}

TEST(ChartLayout, TheLegendStandsBesideAFullOrCrowdedPlot) {
  Chart full = rising();
  for (double y = 0.0; y <= 100.0; y += 5.0) full.series.push_back({.x = {0.0, 100.0}, .y = {y, y}});
  Chart crowded = rising();
  for (int i = 0; i < 6; ++i) crowded.series.push_back({.label = "another"});
  for (const Chart& chart : {full, crowded}) {
    const auto layout = layout_of(chart);
    EXPECT_GE(layout.legend->left, layout.plot.right);
    EXPECT_LE(layout.legend->right, layout.width);
    EXPECT_LE(layout.legend->bottom, layout.height);
    EXPECT_EQ(layout.plot.right - layout.plot.left, layout_of(rising()).plot.right - layout_of(rising()).plot.left);
  }
}

TEST(ChartLayout, TheLegendCoversNoBand) {
  Chart chart = rising();
  chart.bands.push_back({.x = {0, 100}, .low = {0, 0}, .high = {100, 100}});
  const auto layout = layout_of(chart);
  EXPECT_GE(layout.legend->left, layout.plot.right);
}

// Of unstable runs: every line runs from far below the plot to far above.
TEST(ChartLayout, WildDataCostNoMoreThanTheChartIsLarge) {
  Chart chart = rising();
  chart.y.to = 1.0;
  chart.series[0].x.clear();
  chart.series[0].y.clear();
  for (int i = 0; i < 50000; ++i) {
    chart.series[0].x.push_back(i);
    chart.series[0].y.push_back(i % 2 == 0 ? 1e300 : -1e300);
  }
  const auto layout = layout_of(chart);
  EXPECT_TRUE(std::isfinite(layout.y.from));
  EXPECT_TRUE(parsed(to_svg(chart)));
}

TEST(ChartLayout, NotesStayInThePlotAndOffEachOther) {
  Chart chart{.x = {.scale = AxisScale::logarithmic}, .y = {.scale = AxisScale::logarithmic}};
  ChartSeries front{.label = "front", .mark = ChartMark::points};
  for (const double x : {0.01, 0.011, 0.1, 0.12, 3.0, 100.0}) {
    front.x.push_back(x);
    front.y.push_back(1.0 / x);
    chart.notes.push_back({"blank.coarsening=2 model.cell=shell", x, 1.0 / x});
  }
  chart.series = {front};
  const auto layout = layout_of(chart);
  ASSERT_EQ(layout.notes.size(), 6U);
  std::vector<ChartBox> boxes = {*layout.legend};
  for (const auto& note : layout.notes) {
    const double width = text_width(note.text, note_font);
    const ChartBox box{note.to_the_left ? note.x - width : note.x, note.y - note_font / 2,
                       note.to_the_left ? note.x : note.x + width, note.y + note_font / 2};
    EXPECT_GE(box.left, layout.plot.left);
    EXPECT_LE(box.right, layout.plot.right);
    EXPECT_GE(box.top, layout.plot.top);
    EXPECT_LE(box.bottom, layout.plot.bottom);
    for (const auto& other : boxes)
      EXPECT_FALSE(box.left < other.right && other.left < box.right && box.top < other.bottom &&
                   other.top < box.bottom);
    boxes.push_back(box);
  }
}

TEST(ChartTicks, ALogarithmicAxisIsReadableOverAnySpan) {
  for (const double from : {1e-12, 3e-3, 0.7, 1.0, 9.4, 2e7})
    for (const double span : {1.02, 1.5, 3.0, 9.0, 30.0, 1e3, 1e5, 1e9, 1e20}) {
      const auto ticks = log_ticks(from, from * span);
      std::size_t labels = 0;
      double last = 0.0;
      for (const auto& tick : ticks) {
        EXPECT_GE(tick.value, from * (1.0 - 1e-9));
        EXPECT_LE(tick.value, from * span * (1.0 + 1e-9));
        EXPECT_GT(tick.value, last);
        last = tick.value;
        labels += tick.label.empty() ? 0 : 1;
      }
      EXPECT_GE(labels, 2U) << from << " times " << span;
      EXPECT_LE(labels, 14U) << from << " times " << span;
    }
}

TEST(ChartTicks, LabelsAreTheirValues) {
  const auto ticks = log_ticks(1e-6, 1.0);
  EXPECT_EQ(ticks.front().label, "10⁻⁶");
  EXPECT_EQ(ticks.back().label, "1");
  EXPECT_EQ(ticks[ticks.size() - 10].label, "10⁻¹");
  EXPECT_EQ(log_ticks(1.5e5, 5e6).front().label, "2×10⁵");
  EXPECT_EQ(log_ticks(1.5e-4, 5e-3).front().label, "0.0002");
}

// ---- a page

TEST(ChartPage, HasEachChartWithItsOwnIdsAndNoScript) {
  Chart second = some_chart();
  second.caption = "What <it> shows";
  second.series[0].label = "id='gpPt5' href='#gpPt5'";
  const std::string page = to_html("Charts & more", {some_chart(), second});
  std::set<std::string> ids;
  std::size_t count = 0;
  for (auto at = page.find(" id="); at != std::string::npos; at = page.find(" id=", at + 1)) {
    if (page[page.rfind('<', at) + 1] == '/' || page.rfind('>', at) > page.rfind('<', at)) continue;  // a text
    ids.insert(page.substr(at + 5, page.find(page[at + 4], at + 5) - at - 5));
    ++count;
  }
  EXPECT_EQ(ids.size(), count) << "an id of one chart is another's, too";
  std::size_t references = 0;
  for (auto at = page.find("<use xlink:href='#"); at != std::string::npos;
       at = page.find("<use xlink:href='#", at + 1)) {
    const std::string id = page.substr(at + 18, page.find('\'', at + 18) - at - 18);
    EXPECT_TRUE(ids.contains(id)) << id;
    ++references;
  }
  EXPECT_GT(references, 4U);
  EXPECT_EQ(count_of(page, "<svg"), 2U);
  EXPECT_NE(page.find("What &lt;it&gt; shows"), std::string::npos);
  EXPECT_NE(page.find(">id='gpPt5' href='#gpPt5'<"), std::string::npos) << "texts are left as they are";
  for (const char* unwanted : {"<script", "onmouse", "<?xml", "<image"})
    EXPECT_EQ(page.find(unwanted), std::string::npos) << unwanted;
}

// ---- gnuplot itself

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

std::string chart_complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const FileError& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Gnuplot, MissingNamesThePackage) {
  const Path nowhere("/nowhere");
  const std::string complaint = chart_complaint([] { (void)to_svg(some_chart()); });
  EXPECT_NE(complaint.find("gnuplot-nox"), std::string::npos) << complaint;
}

TEST(Gnuplot, FailingIsToldWithItsReason) {
  const std::string complaint = chart_complaint([] { (void)run_gnuplot("plot nonsense(1\n"); });
  EXPECT_NE(complaint.find("exit code 1"), std::string::npos) << complaint;
  EXPECT_NE(complaint.find("line 0"), std::string::npos) << complaint;
  const test::TemporaryFolder folder;
  test::write_text("#!/bin/sh\nkill -9 $$\n", folder.path() / "gnuplot");
  fs::permissions(folder.path() / "gnuplot", fs::perms::owner_all);
  const Path killed(folder.path().string());
  const std::string signal = chart_complaint([] { (void)to_svg(some_chart()); });
  EXPECT_NE(signal.find("signal 9"), std::string::npos) << signal;
}

TEST(ChartFile, WithoutGnuplotAnOlderChartGoesAndTheReasonIsSaidOnce) {
  const test::TemporaryFolder folder;
  const fs::path one = folder.path() / "one.svg", other = folder.path() / "other.svg";
  write_chart(one, some_chart());
  write_chart(other, some_chart());
  EXPECT_TRUE(parsed(test::read_text(one)));
  const Path nowhere("/nowhere");
  std::vector<std::string> said;
  hear_of_missing_charts([&](const std::string& reason) { said.push_back(reason); });
  write_chart(one, some_chart());
  write_chart(other, some_chart());
  hear_of_missing_charts({});
  EXPECT_FALSE(fs::exists(one));
  EXPECT_FALSE(fs::exists(other));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_NE(said.front().find("gnuplot-nox"), std::string::npos) << said.front();
}

}  // namespace
}  // namespace weaveform
