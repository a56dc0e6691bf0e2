// Where things go on a chart: the axes' ranges, the plot, the legend and the notes. Pixels are counted from
// the upper left corner, y downwards.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/chart/chart.hpp"

namespace weaveform {

struct ChartBox {
  double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;  // px
};

// One axis, from values to pixels.
struct ChartScale {
  AxisScale kind = AxisScale::linear;
  double from = 0.0, to = 1.0;                   // values
  double begin = 0.0, end = 1.0;                 // px
  [[nodiscard]] bool shows(double value) const;  // false: there is no place for it on such an axis
  [[nodiscard]] double operator()(double value) const;
};

struct PlacedNote {
  std::string text;
  double x = 0.0, y = 0.0;  // px, its end nearer to the point at half its height
  bool to_the_left = false;
};

struct ChartLayout {
  ChartScale x, y;
  double width = 0.0, height = 0.0;  // px, of the whole chart
  ChartBox plot;
  std::optional<ChartBox> legend;  // none when nothing has a label
  std::vector<PlacedNote> notes;   // those that have a place on both axes
};

inline constexpr double chart_font = 13.0, note_font = 11.0;  // px

// The legend stands in the first corner of the plot that no data runs through, and to the right of the plot where there
// is none or it has more than six entries. A note stands on that side of its point where it meets the least of the
// plot's edge, legend, other notes and data.
[[nodiscard]] ChartLayout layout_of(const Chart& chart);

// Width of a text in an average sans-serif font, px: an estimate, for nobody knows which font the viewer has.
[[nodiscard]] double text_width(const std::string& text, double font_size);

}  // namespace weaveform
