#include "core/chart/chart_layout.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace weaveform {
namespace {

constexpr double margin_left = 92, margin_right = 24, margin_top = 44, margin_bottom = 60;  // px
constexpr double legend_sample = 46, legend_row = 19.5, legend_inset = 8;                   // px
constexpr std::size_t most_inside = 6;                                                      // entries

struct Point {
  double x, y;  // px
};

bool inside(const Point& point, const ChartBox& box) {
  return point.x > box.left && point.x < box.right && point.y > box.top && point.y < box.bottom;
}

bool meet(const ChartBox& a, const ChartBox& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// ---- ranges

struct Extent {
  double from = HUGE_VAL, to = -HUGE_VAL;
  void hold(const std::vector<double>& values, AxisScale kind) {
    const ChartScale scale{.kind = kind};
    for (const double value : values) {
      if (!scale.shows(value)) continue;
      from = std::min(from, value);
      to = std::max(to, value);
    }
  }
};

// Some room on both sides, but not past a zero that all data stay on one side of.
Extent with_room_linear(Extent data) {
  if (data.from > data.to) return {0.0, 1.0};
  const double size = std::max(std::abs(data.from), std::abs(data.to));
  const double span = data.to - data.from;
  const double room = span > 1e-9 * size ? 0.04 * span : size > 0.0 ? 0.5 * size : 1.0;
  const Extent wide{data.from - room, data.to + room};
  return {data.from >= 0.0 && size > 0.0 ? std::max(0.0, wide.from) : wide.from,
          data.to <= 0.0 && size > 0.0 ? std::min(0.0, wide.to) : wide.to};
}

Extent with_room_logarithmic(Extent data) {
  if (data.from > data.to) return {1.0, 10.0};
  const double decades = std::log10(data.to / data.from);
  const double room = std::pow(10.0, decades > 1e-9 ? std::max(0.04, 0.05 * decades) : 0.3);
  return {data.from / room, data.to * room};
}

ChartScale scale_of(const ChartAxis& axis, const Extent& data) {
  const bool linear = axis.scale == AxisScale::linear;
  const Extent range = linear ? with_room_linear(data) : with_room_logarithmic(data);
  ChartScale scale{.kind = axis.scale, .from = range.from, .to = range.to};
  const bool from_given = axis.from && scale.shows(*axis.from), to_given = axis.to && scale.shows(*axis.to);
  if (from_given) scale.from = *axis.from;
  if (to_given) scale.to = *axis.to;
  // A limit that was asked for may lie beyond all data.
  if (scale.from >= scale.to && to_given) scale.from = linear ? scale.to - 1.0 : scale.to / 10.0;
  if (scale.from >= scale.to) scale.to = linear ? scale.from + 1.0 : scale.from * 10.0;
  return scale;
}

void find_ranges(const Chart& chart, ChartLayout& layout) {
  Extent x, y;
  for (const auto& band : chart.bands) {
    x.hold(band.x, chart.x.scale);
    y.hold(band.low, chart.y.scale);
    y.hold(band.high, chart.y.scale);
  }
  for (const auto& series : chart.series) {
    x.hold(series.x, chart.x.scale);
    for (const auto* values : {&series.y, &series.y_low, &series.y_high}) y.hold(*values, chart.y.scale);
  }
  layout.x = scale_of(chart.x, x);
  layout.y = scale_of(chart.y, y);
  layout.x.begin = layout.plot.left;
  layout.x.end = layout.plot.right;
  layout.y.begin = layout.plot.bottom;
  layout.y.end = layout.plot.top;
}

// ---- legend

// Where there is ink: places on the chart, at most one in each square of a few pixels, however many data there are.
class Ink {
public:
  Ink(const Chart& chart, const ChartLayout& layout);
  [[nodiscard]] std::ptrdiff_t count_in(const ChartBox& box) const {
    return std::count_if(places_.begin(), places_.end(), [&](const Point& point) { return inside(point, box); });
  }

private:
  static constexpr double square = 4.0, step = 8.0;  // px; no text slips between two steps along a line
  void add(const Point& point) {
    if (!inside(point, {0.0, 0.0, layout_.width, layout_.height})) return;
    const auto column = static_cast<std::size_t>(point.x / square), row = static_cast<std::size_t>(point.y / square);
    const std::size_t index = row * columns_ + column;
    if (!taken_[index]) places_.push_back(point);
    taken_[index] = true;
  }
  void add(const std::vector<double>& x, const std::vector<double>& y, bool joined);
  void add(const ChartBand& band);

  const ChartLayout& layout_;
  std::size_t columns_;
  std::vector<bool> taken_;
  std::vector<Point> places_;
};

Ink::Ink(const Chart& chart, const ChartLayout& layout)
    : layout_(layout),
      columns_(static_cast<std::size_t>(layout.width / square) + 1),
      taken_(columns_ * (static_cast<std::size_t>(layout.height / square) + 1)) {
  for (const auto& band : chart.bands) add(band);
  for (const auto& series : chart.series) {
    add(series.x, series.y, series.mark != ChartMark::points);
    add(series.x, series.y_low, false);
    add(series.x, series.y_high, false);
  }
}

void Ink::add(const std::vector<double>& x, const std::vector<double>& y, bool joined) {
  Point last{};
  bool follows = false;  // on `last`, with nothing undrawable between
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!layout_.x.shows(x[i]) || !layout_.y.shows(y[i])) {
      follows = false;
      continue;
    }
    const Point here{layout_.x(x[i]), layout_.y(y[i])};
    // A line that goes far beyond the chart needs no steps there.
    const double length = follows && joined ? std::hypot(here.x - last.x, here.y - last.y) : 0.0;
    const int steps = static_cast<int>(std::min(length, 1e4) / step);
    for (int k = 1; k <= steps; ++k) {
      const double part = static_cast<double>(k) / (steps + 1);
      add({last.x + part * (here.x - last.x), last.y + part * (here.y - last.y)});
    }
    add(here);
    last = here;
    follows = true;
  }
}

// Both edges and so many lines between them that no text slips between.
void Ink::add(const ChartBand& band) {
  constexpr int lines = 40;
  for (int k = 0; k <= lines; ++k) {
    const double part = static_cast<double>(k) / lines;
    std::vector<double> y;
    for (std::size_t i = 0; i < std::min(band.low.size(), band.high.size()); ++i)
      y.push_back(band.low[i] + part * (band.high[i] - band.low[i]));
    add(band.x, y, true);
  }
}

std::vector<std::string> labels_of(const Chart& chart) {
  std::vector<std::string> labels;
  for (const auto& band : chart.bands)
    if (!band.label.empty()) labels.push_back(band.label);
  for (const auto& series : chart.series)
    if (!series.label.empty()) labels.push_back(series.label);
  return labels;
}

void place_legend(const Chart& chart, const Ink& ink, ChartLayout& layout) {
  const auto labels = labels_of(chart);
  if (labels.empty()) return;
  double width = 0.0;
  for (const auto& label : labels) width = std::max(width, legend_sample + text_width(label, chart_font));
  const double height = legend_row * static_cast<double>(labels.size());
  const ChartBox& plot = layout.plot;
  const auto box_at = [&](double left, double top) { return ChartBox{left, top, left + width, top + height}; };
  const double right = plot.right - legend_inset - width, below = plot.bottom - legend_inset - height;
  const double left = plot.left + legend_inset, above = plot.top + legend_inset;
  const bool fits = width < 0.6 * (plot.right - plot.left) && height < 0.6 * (plot.bottom - plot.top);
  if (fits && labels.size() <= most_inside) {
    for (const ChartBox& box : {box_at(left, above), box_at(right, above), box_at(right, below), box_at(left, below)}) {
      if (ink.count_in(box) > 0) continue;
      layout.legend = box;
      return;
    }
  }
  layout.legend = box_at(plot.right + legend_inset, plot.top);
  layout.width += width + legend_inset;
  layout.height = std::max(layout.height, plot.top + height + legend_inset);
}

// ---- notes

struct Place {
  double right, down;  // px from the point
  bool to_the_left;
};
constexpr std::array<Place, 10> places = {{{7, -9, false},
                                           {-7, 11, true},
                                           {7, 11, false},
                                           {-7, -9, true},
                                           {9, 0, false},
                                           {-9, 0, true},
                                           {7, -24, false},
                                           {-7, 26, true},
                                           {7, 26, false},
                                           {-7, -24, true}}};

ChartBox box_of(const Point& point, const Place& place, double width) {
  const double x = point.x + place.right, y = point.y + place.down, half = 0.5 * note_font + 1.0;
  return {place.to_the_left ? x - width : x, y - half, place.to_the_left ? x : x + width, y + half};
}

void place_notes(const Chart& chart, const Ink& ink, ChartLayout& layout) {
  std::vector<ChartBox> taken;
  if (layout.legend) taken.push_back(*layout.legend);
  for (const auto& note : chart.notes) {
    if (!layout.x.shows(note.x) || !layout.y.shows(note.y)) continue;
    const Point point{layout.x(note.x), layout.y(note.y)};
    const double width = text_width(note.text, note_font);
    // In the order of badness: beyond the plot, over another text, over data.
    const auto cost = [&](const Place& place) {
      const ChartBox box = box_of(point, place, width);
      const ChartBox& plot = layout.plot;
      const bool beyond =
          box.left < plot.left || box.right > plot.right || box.top < plot.top || box.bottom > plot.bottom;
      const auto texts = std::count_if(taken.begin(), taken.end(), [&](const ChartBox& b) { return meet(b, box); });
      return (beyond ? 1e4 : 0.0) + 1e2 * static_cast<double>(texts) +
             std::min(99.0, static_cast<double>(ink.count_in(box)));
    };
    const Place& best = *std::min_element(places.begin(), places.end(),
                                          [&](const Place& a, const Place& b) { return cost(a) < cost(b); });
    taken.push_back(box_of(point, best, width));
    layout.notes.push_back({note.text, point.x + best.right, point.y + best.down, best.to_the_left});
  }
}

}  // namespace

bool ChartScale::shows(double value) const {
  return std::isfinite(value) && (kind == AxisScale::linear || value > 0.0);
}

double ChartScale::operator()(double value) const {
  const auto place = [this](double v) { return kind == AxisScale::linear ? v : std::log10(v); };
  return begin + (end - begin) * (place(value) - place(from)) / (place(to) - place(from));
}

double text_width(const std::string& text, double font_size) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  const auto letters = static_cast<std::ptrdiff_t>(text.size()) - std::count_if(text.begin(), text.end(), continues);
  return 0.58 * font_size * static_cast<double>(letters);
}

ChartLayout layout_of(const Chart& chart) {
  ChartLayout layout;
  layout.width = chart.width;
  layout.height = chart.height;
  layout.plot = {margin_left, margin_top, chart.width - margin_right, chart.height - margin_bottom};
  find_ranges(chart, layout);
  const Ink ink(chart, layout);
  place_legend(chart, ink, layout);
  place_notes(chart, ink, layout);
  return layout;
}

}  // namespace weaveform
