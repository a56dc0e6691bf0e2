// Charts where text is hostile, several share a page, or node is missing or fails.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"
#include "core/error.hpp"
#include "solver/result/chart_file.hpp"
#include "tests/support/run_command.hpp"
#include "tests/unit/core/chart/drawing.hpp"

namespace weaveform::test {
namespace {

namespace fs = std::filesystem;
using DrawnText = DrawnChart;
using DrawnPage = DrawnChart;
using ChartFile = DrawnChart;

TEST_F(DrawnText, IsNeverACommandOrMarkup) {
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
  write_text("#!/bin/sh\n" + script + "\n", folder.path() / "node");
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
  const TemporaryFolder folder;
  const fs::path one = folder.path() / "one.svg", other = folder.path() / "other.svg";
  write_charts({{one, some_chart()}, {other, some_chart()}});
  EXPECT_TRUE(seen(read_text(one)).well_formed);
  EXPECT_EQ(read_text(one), read_text(other));
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
}  // namespace weaveform::test
