// Charts as SVG: lines, points and bands over linear or logarithmic axes, with ticks and a legend. Text in, text out;
// no font, script or file is needed to look at one. Values that are not finite, or not positive on a logarithmic axis,
// interrupt a line and are not drawn.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace weaveform {

enum class AxisScale { linear, logarithmic };

struct ChartAxis {
  std::string title = {};  // with its unit: "shear angle (deg)"
  AxisScale scale = AxisScale::linear;
  std::optional<double> from = {}, to = {};  // none: from the data, widened to round numbers
};

enum class ChartMark { line, dashed, points };

struct ChartSeries {
  std::string label = {};  // "" stays out of the legend
  std::vector<double> x = {}, y = {};
  ChartMark mark = ChartMark::line;
  int colour = -1;  // index into a palette told apart by the colour-blind (Okabe & Ito 2008); -1: the next in turn
};

// The area between low and high.
struct ChartBand {
  std::string label = {};
  std::vector<double> x = {}, low = {}, high = {};
  int colour = -1;
};

// A word beside a point of the plot.
struct ChartNote {
  std::string text = {};
  double x = 0.0, y = 0.0;
};

struct Chart {
  std::string title = {};
  ChartAxis x = {}, y = {};
  std::vector<ChartBand> bands = {};     // drawn first
  std::vector<ChartSeries> series = {};  // in order, later ones on top
  int width = 760, height = 480;         // px
  std::vector<ChartNote> notes = {};     // on top of all
};

[[nodiscard]] std::string to_svg(const Chart& chart);

// Round numbers from `from` to `to`, some `wanted` of them: steps of 1, 2 or 5 times a power of ten on a linear axis;
// powers of ten, with 2 and 5 between when there are few, on a logarithmic one.
[[nodiscard]] std::vector<double> chart_ticks(double from, double to, AxisScale scale, int wanted = 6);

}  // namespace weaveform
