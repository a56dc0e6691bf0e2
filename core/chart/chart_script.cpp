#include "core/chart/chart_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "core/chart/chart_layout.hpp"
#include "core/chart/chart_ticks.hpp"

namespace weaveform {
namespace {

// Okabe & Ito (2008) without their yellow, which is lost on white.
constexpr std::array palette = {"0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9", "000000"};
// gnuplot's point types: disc, square, triangle, diamond, triangle downwards, then the same hollow, then crosses.
constexpr std::array shapes = {7, 5, 9, 13, 11, 6, 4, 8, 12, 10, 1, 2};
constexpr const char* dashes = " dt (9,5)";
constexpr const char* ink = "#404040";

template <class Array>
auto turn(const Array& all, int index) {
  return all[static_cast<std::size_t>(index) % all.size()];
}

// ---- texts

// Length of the UTF-8 sequence that begins here, 0 when there is none that XML may hold.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  const std::size_t length = lead < 0x80 ? 1 : lead >= 0xC2 && lead < 0xE0 ? 2 : lead >= 0xE0 && lead < 0xF0 ? 3 : 4;
  if ((lead >= 0x80 && lead < 0xC2) || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  // Longer than need be, surrogates, beyond Unicode, and U+FFFE, U+FFFF.
  if ((lead == 0xE0 && byte(1) < 0xA0) || (lead == 0xED && byte(1) >= 0xA0)) return 0;
  if ((lead == 0xF0 && byte(1) < 0x90) || (lead == 0xF4 && byte(1) >= 0x90)) return 0;
  if (lead == 0xEF && byte(1) == 0xBF && byte(2) >= 0xBE) return 0;
  return length;
}

bool plain(char c) {
  constexpr std::string_view harmless = " .,;:()/+-=<>_";
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
         harmless.find(c) != std::string_view::npos;
}

std::string font(double size) {
  return fmt::format("font \"sans-serif,{:.3g}\"", size);
}

// ---- data

std::string number(double value) {
  return fmt::format("{:.12g}", value);
}

// A blank line, where something cannot be drawn, interrupts the line.
class Table {
public:
  explicit Table(std::size_t name) : text_(fmt::format("$d{} << END\n", name)) {}
  void row(std::initializer_list<double> values) {
    if (gap_ && rows_ > 0) text_ += "\n";
    gap_ = false;
    ++rows_;
    for (const double value : values) text_ += number(value) + " ";
    text_.back() = '\n';
  }
  void gap() { gap_ = true; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] std::string text() const { return text_ + "END\n"; }

private:
  std::string text_;
  bool gap_ = false;
  int rows_ = 0;
};

// ---- what is plotted

struct Plotting {
  const ChartLayout& layout;
  std::string data, plots;  // so far
  std::vector<std::string> labels;
  int next_colour = 0;

  // `drawing` is what follows the data's name; without rows only the legend shows it.
  void add(const Table& table, const std::string& columns, const std::string& drawing, const std::string& label,
           bool explained) {
    const std::string title = explained && !label.empty() ? "title " + gnuplot_quoted(label) : "notitle";
    if (table.rows() == 0 && title == "notitle") return;
    const std::string source =
        table.rows() > 0 ? fmt::format("$d{} using {}", labels.size(), columns) : std::string("keyentry");
    if (table.rows() > 0) data += table.text();
    plots += fmt::format("{}  {} {} {}", plots.empty() ? "" : ", \\\n", source, drawing, title);
    labels.push_back(label);
  }
  [[nodiscard]] Table table() const { return Table(labels.size()); }
  [[nodiscard]] int colour(int wanted) { return wanted >= 0 ? wanted : next_colour++; }
};

void add_band(const ChartBand& band, Plotting& plotting) {
  const ChartLayout& layout = plotting.layout;
  Table table = plotting.table();
  for (std::size_t i = 0; i < std::min({band.x.size(), band.low.size(), band.high.size()}); ++i) {
    const bool to_the_end = layout.y.kind == AxisScale::logarithmic && band.low[i] <= 0.0;
    const double low = to_the_end ? layout.y.from : band.low[i];
    if (layout.x.shows(band.x[i]) && layout.y.shows(low) && layout.y.shows(band.high[i]))
      table.row({band.x[i], low, band.high[i]});
    else
      table.gap();
  }
  plotting.add(table, "1:2:3",
               fmt::format("with filledcurves fc rgb \"#{}\" fs transparent solid 0.18 noborder",
                           turn(palette, plotting.colour(band.colour))),
               band.label, true);
}

// Smaller the more there are, and where they are many one shines through the other.
std::string points_style(int rows, const char* colour, int shape) {
  const double size = rows > 400 ? 0.35 : rows > 60 ? 0.5 : 0.8;
  return fmt::format("with points pt {} ps {} lw 1.2 lc rgb \"#{}{}\"", turn(shapes, shape), size,
                     rows > 400 ? "60" : "", colour);
}

void add_error_bars(const ChartSeries& series, const char* colour, Plotting& plotting) {
  const ChartLayout& layout = plotting.layout;
  Table table = plotting.table();
  for (std::size_t i = 0; i < std::min({series.x.size(), series.y.size(), series.y_low.size(), series.y_high.size()});
       ++i) {
    const bool to_the_end = layout.y.kind == AxisScale::logarithmic && series.y_low[i] <= 0.0;
    const double low = to_the_end ? layout.y.from : series.y_low[i];
    if (layout.x.shows(series.x[i]) && layout.y.shows(series.y[i]) && layout.y.shows(low) &&
        layout.y.shows(series.y_high[i]))
      table.row({series.x[i], low, series.y_high[i] - low});
  }
  // Arrows with flat heads: gnuplot's own error bars come with a white disc in the middle.
  plotting.add(table, "1:2:(0):3",
               fmt::format("with vectors heads nofilled size screen 0.005,90 lw 1 lc rgb \"#{}\"", colour),
               series.label, false);
}

void add_series(const ChartSeries& series, Plotting& plotting) {
  const ChartLayout& layout = plotting.layout;
  const int index = plotting.colour(series.colour);
  const char* colour = turn(palette, index);
  add_error_bars(series, colour, plotting);
  Table table = plotting.table();
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    if (layout.x.shows(series.x[i]) && layout.y.shows(series.y[i]))
      table.row({series.x[i], series.y[i]});
    else if (series.mark != ChartMark::points)
      table.gap();
  }
  const std::string drawing =
      series.mark == ChartMark::points
          ? points_style(table.rows(), colour, series.shape >= 0 ? series.shape : index)
          : fmt::format("with lines lw 1.8 lc rgb \"#{}\"{}", colour, series.mark == ChartMark::dashed ? dashes : "");
  plotting.add(table, "1:2", drawing, series.label, true);
}

// ---- what stands around it

// gnuplot's "screen" coordinates, which run upwards from 0 to 1.
std::string place(const ChartLayout& layout, double x, double y) {
  return fmt::format("screen {:.6f},{:.6f}", x / layout.width, 1.0 - y / layout.height);
}

std::string axis_commands(char axis, const ChartScale& scale) {
  std::string text = fmt::format("set {}range [{}:{}]\n", axis, number(scale.from), number(scale.to));
  if (scale.kind == AxisScale::linear) return text + fmt::format("set {}tics format \"%.6g\"\n", axis);
  std::string ticks;
  for (const auto& tick : log_ticks(scale.from, scale.to))
    ticks += fmt::format("{}{} {} {}", ticks.empty() ? "" : ", ", gnuplot_quoted(tick.label), number(tick.value),
                         tick.label.empty() ? 1 : 0);
  return text + fmt::format("set logscale {0}\nset {0}tics ({1})\n", axis, ticks);
}

std::string frame_commands(const Chart& chart, const ChartLayout& layout) {
  const ChartBox& plot = layout.plot;
  std::string text = fmt::format(
      "set encoding utf8\n"
      "set terminal svg noenhanced dynamic size {:.0f},{:.0f} {} background \"#ffffff\" dashlength 1\n"
      "set lmargin at screen {:.6f}\nset rmargin at screen {:.6f}\n"
      "set bmargin at screen {:.6f}\nset tmargin at screen {:.6f}\n"
      "set minussign\nset clip two\nset xtics offset 0,0.4\nset xlabel offset 0,0.6\n"
      "set border 3 lw 1 lc rgb \"{}\"\nset tics nomirror out scale 0.6,0.3\nset grid lt 1 lw 0.6 lc rgb \"#e0e0e0\"\n",
      layout.width, layout.height, font(chart_font), plot.left / layout.width, plot.right / layout.width,
      1.0 - plot.bottom / layout.height, 1.0 - plot.top / layout.height, ink);
  // A long title is set smaller, so that it does not run out of the chart.
  constexpr double title_font = 15.0, least_font = 9.0;
  const double fit =
      title_font * (layout.width - plot.left - 10.0) / std::max(1.0, text_width(chart.title, title_font));
  text += fmt::format("set label 1 {} at {} left {}\n", gnuplot_quoted(chart.title), place(layout, plot.left, 22),
                      font(std::clamp(fit, least_font, title_font)));
  text += fmt::format("set xlabel {} {}\n", gnuplot_quoted(chart.x.title), font(chart_font));
  // gnuplot would put it beside the widest number, whose width it overrates.
  text += fmt::format("set label 2 {} at {} center rotate by 90 {}\n", gnuplot_quoted(chart.y.title),
                      place(layout, 18, 0.5 * (plot.top + plot.bottom)), font(chart_font));
  return text + axis_commands('x', layout.x) + axis_commands('y', layout.y);
}

std::string legend_and_notes(const ChartLayout& layout) {
  std::string text = "set key off\n";
  if (layout.legend)
    text = fmt::format("set key at {} left top Left reverse vertical noautotitle samplen 2.5 spacing 1.0 {}\n",
                       place(layout, layout.legend->left, layout.legend->top), font(chart_font));
  int count = 2;  // after the titles of chart and y axis
  for (const auto& note : layout.notes)
    text += fmt::format("set label {} {} at {} {} front {}\n", ++count, gnuplot_quoted(note.text),
                        place(layout, note.x, note.y), note.to_the_left ? "right" : "left", font(note_font));
  return text;
}

}  // namespace

std::string chart_text(const std::string& text) {
  std::string clean;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(std::string_view(text).substr(i));
    const bool control = length == 1 && (static_cast<unsigned char>(text[i]) < ' ' || text[i] == '\x7F');
    clean += control ? " " : length == 0 ? "\xEF\xBF\xBD" : text.substr(i, length);
    i += std::max<std::size_t>(length, 1);
  }
  return clean;
}

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : chart_text(text)) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : chart_text(text)) {
    // Bytes of letters beyond ASCII mean nothing to gnuplot.
    const auto byte = static_cast<unsigned char>(c);
    quoted += plain(c) || byte >= 0x80 ? std::string(1, c) : fmt::format("\\{:03o}", byte);
  }
  return quoted + "\"";
}

ChartScript gnuplot_script(const Chart& chart) {
  const ChartLayout layout = layout_of(chart);
  Plotting plotting{layout, "", "", {}};
  for (const auto& band : chart.bands) add_band(band, plotting);
  for (const auto& series : chart.series) add_series(series, plotting);
  // gnuplot draws no axes without something to plot.
  if (plotting.data.empty()) plotting.plots += plotting.plots.empty() ? "  NaN notitle" : ", \\\n  NaN notitle";
  return {
      frame_commands(chart, layout) + legend_and_notes(layout) + plotting.data + "plot \\\n" + plotting.plots + "\n",
      plotting.labels};
}

}  // namespace weaveform
