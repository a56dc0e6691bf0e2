// Charts: plain data in, a figure as SVG or as a web page out. ECharts draws them, here in node (Debian package nodejs, run
// as a child process with the script core/chart/echarts/packed), in the reports' pages in the browser. Values that are not
// finite (or beyond 1e300), or not positive on a logarithmic axis, interrupt a line and are not drawn. Texts are UTF-8, one
// line each: a line break becomes a blank, what is not UTF-8 a replacement character; those too long for their place are
// set smaller, then shortened.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace weaveform {

enum class AxisScale { linear, logarithmic };

struct ChartAxis {
  std::string title = {};  // with its unit: "shear angle (deg)"
  AxisScale scale = AxisScale::linear;
  std::optional<double> from = {}, to = {};  // none: from the data, with some room
};

inline constexpr int chart_colours = 8;  // that differ

enum class ChartMark { line, dashed, points };

struct ChartSeries {
  std::string label = {};  // "" stays out of the legend
  std::vector<double> x = {}, y = {};
  ChartMark mark = ChartMark::line;
  int colour = -1;  // index into chart_colours told apart by the colour-blind (Okabe & Ito 2008); -1: the next in turn
  std::vector<double> y_low = {}, y_high = {};  // ends of error bars; empty: none; a value that is not finite: no bar
  int shape =
      -1;  // of points, by number (disc, square, triangle, ...); -1: the colour's, so that print tells them apart
};

// The area between low and high. On a logarithmic axis a low that is not positive is the axis' lower end.
struct ChartBand {
  std::string label = {};
  std::vector<double> x = {}, low = {}, high = {};
  int colour = -1;
};

// A word beside a point of the plot, on whichever side there is room.
struct ChartNote {
  std::string text = {};
  double x = 0.0, y = 0.0;
};

struct Chart {
  std::string title = {};
  ChartAxis x = {}, y = {};
  std::vector<ChartBand> bands = {};     // drawn first
  std::vector<ChartSeries> series = {};  // in order, later ones on top
  int width = 760, height = 480;         // px; the legend, above the plot, comes on top of the height
  std::vector<ChartNote> notes = {};     // on top of all
  std::string caption = {};              // below the chart in to_html; "": none
};

// The same chart gives the same bytes (with the same node). Series are told by their label when pointed at. Throws
// FileError when node is missing or fails.
[[nodiscard]] std::string to_svg(const Chart& chart);

// The same of each, by one process.
[[nodiscard]] std::vector<std::string> to_svgs(const std::vector<Chart>& charts);

// One page with all charts, complete in itself: no script, font or image from elsewhere. Throws FileError as to_svg.
[[nodiscard]] std::string to_html(const std::string& title, const std::vector<Chart>& charts);

}  // namespace weaveform
