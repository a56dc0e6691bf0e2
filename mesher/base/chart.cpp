#include "mesher/base/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace weaveform {
namespace {

constexpr std::array palette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr double left = 78, right = 20, top = 42, bottom = 58;  // px; margins around the plot
constexpr double legend_line = 18;                              // px

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

const char* colour_at(int index) {
  return palette[static_cast<std::size_t>(index) % palette.size()];
}

// From values to pixels along one axis.
struct Scale {
  AxisScale kind = AxisScale::linear;
  double from = 0.0, to = 1.0;    // values
  double begin = 0.0, end = 1.0;  // px
  [[nodiscard]] bool shows(double value) const {
    return std::isfinite(value) && (kind == AxisScale::linear || value > 0.0);
  }
  [[nodiscard]] double operator()(double value) const {
    const auto place = [this](double v) { return kind == AxisScale::linear ? v : std::log10(v); };
    return begin + (end - begin) * (place(value) - place(from)) / (place(to) - place(from));
  }
};

struct Extent {
  double from = HUGE_VAL, to = -HUGE_VAL;
  void hold(const std::vector<double>& values, const Scale& scale) {
    for (const double value : values) {
      if (!scale.shows(value)) continue;
      from = std::min(from, value);
      to = std::max(to, value);
    }
  }
};

double linear_step(double from, double to, int wanted) {
  const double raw = (to - from) / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

Scale scale_of(const ChartAxis& axis, Extent extent, double begin, double end) {
  Scale scale{axis.scale, 0.0, 1.0, begin, end};
  if (extent.from > extent.to) extent = axis.scale == AxisScale::linear ? Extent{0.0, 1.0} : Extent{1.0, 10.0};
  if (axis.scale == AxisScale::linear) {
    // A single value gets room on both sides.
    if (extent.from == extent.to) {
      const double room = extent.from == 0.0 ? 1.0 : 0.5 * std::abs(extent.from);
      extent = {extent.from - room, extent.to + room};
    }
    const double step = linear_step(extent.from, extent.to, 6);
    scale.from = step * std::floor(extent.from / step + 1e-9);
    scale.to = step * std::ceil(extent.to / step - 1e-9);
  } else {
    scale.from = std::pow(10.0, std::floor(std::log10(extent.from) + 1e-9));
    scale.to = std::pow(10.0, std::ceil(std::log10(extent.to) - 1e-9));
    if (scale.from == scale.to) scale.to *= 10.0;
  }
  scale.from = axis.from.value_or(scale.from);
  scale.to = axis.to.value_or(scale.to);
  return scale;
}

// Runs of drawable points, "x,y x,y ...": whatever cannot be drawn ends a run.
std::vector<std::string> runs_of(const std::vector<double>& x, const std::vector<double>& y, const Scale& sx,
                                 const Scale& sy) {
  std::vector<std::string> runs(1);
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!sx.shows(x[i]) || !sy.shows(y[i])) {
      if (!runs.back().empty()) runs.emplace_back();
      continue;
    }
    runs.back() += fmt::format("{}{:.2f},{:.2f}", runs.back().empty() ? "" : " ", sx(x[i]), sy(y[i]));
  }
  if (runs.back().empty()) runs.pop_back();
  return runs;
}

std::string tick_text(double value) {
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  return size >= 1e5 || size < 1e-3 ? fmt::format("{:.3g}", value) : fmt::format("{:.6g}", value);
}

std::string x_axis(const ChartAxis& axis, const Scale& scale, const Scale& other) {
  std::string svg;
  for (const double tick : chart_ticks(scale.from, scale.to, scale.kind)) {
    const double x = scale(tick);
    svg += fmt::format("<line class=\"grid\" x1=\"{0:.2f}\" y1=\"{1:.2f}\" x2=\"{0:.2f}\" y2=\"{2:.2f}\"/>\n", x,
                       other.begin, other.end);
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n", x, other.begin + 18,
                       tick_text(tick));
  }
  return svg + fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n",
                           0.5 * (scale.begin + scale.end), other.begin + 42, escaped(axis.title));
}

std::string y_axis(const ChartAxis& axis, const Scale& scale, const Scale& other) {
  std::string svg;
  for (const double tick : chart_ticks(scale.from, scale.to, scale.kind)) {
    const double y = scale(tick);
    svg += fmt::format("<line class=\"grid\" x1=\"{1:.2f}\" y1=\"{0:.2f}\" x2=\"{2:.2f}\" y2=\"{0:.2f}\"/>\n", y,
                       other.begin, other.end);
    svg += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", other.begin - 8, y + 4,
                       tick_text(tick));
  }
  const double middle = 0.5 * (scale.begin + scale.end);
  return svg + fmt::format(
                   "<text x=\"18\" y=\"{0:.2f}\" text-anchor=\"middle\" transform=\"rotate(-90 18 {0:.2f})\">{1}"
                   "</text>\n",
                   middle, escaped(axis.title));
}

std::string band_shape(const ChartBand& band, int colour, const Scale& sx, const Scale& sy) {
  // There along the upper edge and back along the lower one.
  std::vector<double> x = band.x, y = band.high;
  x.insert(x.end(), band.x.rbegin(), band.x.rend());
  y.insert(y.end(), band.low.rbegin(), band.low.rend());
  std::string points;
  for (const auto& run : runs_of(x, y, sx, sy)) points += (points.empty() ? "" : " ") + run;
  return fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"0.18\"/>\n", points, colour_at(colour));
}

std::string series_shape(const ChartSeries& series, int colour, const Scale& sx, const Scale& sy) {
  std::string svg;
  if (series.mark == ChartMark::points) {
    svg = fmt::format("<g fill=\"{}\" fill-opacity=\"0.75\">\n", colour_at(colour));
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (sx.shows(series.x[i]) && sy.shows(series.y[i]))
        svg += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.2\"/>\n", sx(series.x[i]), sy(series.y[i]));
    }
    return svg + "</g>\n";
  }
  const char* dash = series.mark == ChartMark::dashed ? " stroke-dasharray=\"6 4\"" : "";
  for (const auto& run : runs_of(series.x, series.y, sx, sy))
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\"{}/>\n", run,
                       colour_at(colour), dash);
  return svg;
}

// To the upper right of its point, or to the lower left in the right half of the plot, where it might run out of it.
std::string note_text(const ChartNote& note, const Scale& sx, const Scale& sy) {
  if (!sx.shows(note.x) || !sy.shows(note.y)) return "";
  const bool left_half = sx(note.x) < 0.5 * (sx.begin + sx.end);
  return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"11\" text-anchor=\"{}\">{}</text>\n",
                     sx(note.x) + (left_half ? 7.0 : -7.0), sy(note.y) + (left_half ? -6.0 : 14.0),
                     left_half ? "start" : "end", escaped(note.text));
}

// One line of the legend at the upper left of the plot.
std::string legend_entry(const std::string& label, const std::string& sample, int row) {
  return fmt::format("<g transform=\"translate({:.2f} {:.2f})\">{}<text x=\"34\" y=\"4\">{}</text></g>\n", left + 12,
                     top + 16 + legend_line * row, sample, escaped(label));
}

std::string sample_of(const ChartSeries& series, int colour) {
  if (series.mark == ChartMark::points)
    return fmt::format("<circle cx=\"13\" cy=\"0\" r=\"2.6\" fill=\"{}\"/>", colour_at(colour));
  const char* dash = series.mark == ChartMark::dashed ? " stroke-dasharray=\"6 4\"" : "";
  return fmt::format("<line x1=\"0\" y1=\"0\" x2=\"26\" y2=\"0\" stroke=\"{}\" stroke-width=\"1.8\"{}/>",
                     colour_at(colour), dash);
}

// The two axes, wide enough for everything on the chart.
std::array<Scale, 2> scales_of(const Chart& chart) {
  const Scale as_x{chart.x.scale}, as_y{chart.y.scale};
  Extent x, y;
  for (const auto& band : chart.bands) {
    x.hold(band.x, as_x);
    y.hold(band.low, as_y);
    y.hold(band.high, as_y);
  }
  for (const auto& series : chart.series) {
    x.hold(series.x, as_x);
    y.hold(series.y, as_y);
  }
  return {scale_of(chart.x, x, left, chart.width - right), scale_of(chart.y, y, chart.height - bottom, top)};
}

struct Drawing {
  std::string shapes, legend;
};

Drawing draw(const Chart& chart, const Scale& sx, const Scale& sy) {
  Drawing drawing;
  int next = 0, row = 0;
  const auto colour_for = [&next](int colour) { return colour >= 0 ? colour : next++; };
  const auto explain = [&](const std::string& label, const std::string& sample) {
    if (!label.empty()) drawing.legend += legend_entry(label, sample, row++);
  };
  for (const auto& band : chart.bands) {
    const int colour = colour_for(band.colour);
    drawing.shapes += band_shape(band, colour, sx, sy);
    explain(band.label,
            fmt::format("<rect x=\"0\" y=\"-6\" width=\"26\" height=\"12\" fill=\"{}\" fill-opacity=\"0.18\"/>",
                        colour_at(colour)));
  }
  for (const auto& series : chart.series) {
    const int colour = colour_for(series.colour);
    drawing.shapes += series_shape(series, colour, sx, sy);
    explain(series.label, sample_of(series, colour));
  }
  for (const auto& note : chart.notes) drawing.shapes += note_text(note, sx, sy);
  return drawing;
}

}  // namespace

std::vector<double> chart_ticks(double from, double to, AxisScale scale, int wanted) {
  std::vector<double> ticks;
  if (scale == AxisScale::linear) {
    const double step = linear_step(from, to, wanted);
    const auto first = static_cast<long>(std::ceil(from / step - 1e-9));
    const auto last = static_cast<long>(std::floor(to / step + 1e-9));
    for (long n = first; n <= last; ++n) ticks.push_back(static_cast<double>(n) * step);
    return ticks;
  }
  const bool few = std::log10(to / from) < 3.0;
  const int first = static_cast<int>(std::floor(std::log10(from) + 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(to) + 1e-9));
  for (int power = first; power <= last; ++power) {
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double tick = factor * std::pow(10.0, power);
      if ((few || factor == 1.0) && tick >= from * (1.0 - 1e-9) && tick <= to * (1.0 + 1e-9)) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::string to_svg(const Chart& chart) {
  const auto [sx, sy] = scales_of(chart);
  const Drawing drawing = draw(chart, sx, sy);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<style>.grid{{stroke:#d8d8d8;stroke-width:1}}</style>\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"#ffffff\"/>\n"
      "<text x=\"{2:.2f}\" y=\"24\" font-size=\"15\" font-weight=\"bold\">{3}</text>\n",
      chart.width, chart.height, left, escaped(chart.title));
  svg += x_axis(chart.x, sx, sy) + y_axis(chart.y, sy, sx);
  const std::string plot = fmt::format("x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"", sx.begin, sy.end,
                                       sx.end - sx.begin, sy.begin - sy.end);
  svg += fmt::format(
      "<clipPath id=\"plot\"><rect {0}/></clipPath>\n<g clip-path=\"url(#plot)\">\n{1}</g>\n"
      "<rect {0} fill=\"none\" stroke=\"#444444\"/>\n",
      plot, drawing.shapes);
  return svg + drawing.legend + "</svg>\n";
}

}  // namespace weaveform
