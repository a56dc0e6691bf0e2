// Charts: plain data in, a figure as SVG or as a web page out. gnuplot draws them (Debian package gnuplot-nox, run as a
// child process); what is ours is the translation (chart_script.hpp) and where legend and notes go (chart_layout.hpp).
// Values that are not finite, or not positive on a logarithmic axis, interrupt a line and are not drawn. Texts are
// UTF-8, one line each: a line break becomes a blank, what is not UTF-8 a replacement character.
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

enum class ChartMark { line, dashed, points };

struct ChartSeries {
  std::string label = {};  // "" stays out of the legend
  std::vector<double> x = {}, y = {};
  ChartMark mark = ChartMark::line;
  int colour = -1;  // index into a palette told apart by the colour-blind (Okabe & Ito 2008); -1: the next in turn
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
  int width = 760, height = 480;         // px; a legend beside the plot comes on top of the width
  std::vector<ChartNote> notes = {};     // on top of all
  std::string caption = {};              // below the chart in to_html; "": none
};

// The same chart gives the same bytes (with the same gnuplot). Series are told by their label when pointed at.
// Throws FileError when gnuplot is missing or fails.
[[nodiscard]] std::string to_svg(const Chart& chart);

// One page with all charts, complete in itself: no script, font or image from elsewhere. Throws FileError as to_svg.
[[nodiscard]] std::string to_html(const std::string& title, const std::vector<Chart>& charts);

}  // namespace weaveform
