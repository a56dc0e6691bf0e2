// A chart in gnuplot's language, data included.
#pragma once

#include <string>
#include <vector>

#include "core/chart/chart.hpp"

namespace weaveform {

struct ChartScript {
  std::string text;
  // Of each element as gnuplot counts them ("gnuplot_plot_1" is the first); those of error bars are their series'.
  std::vector<std::string> labels;
};

// Writes SVG to gnuplot's standard output. Nothing that a text of the chart holds is ever a command.
[[nodiscard]] ChartScript gnuplot_script(const Chart& chart);

// The text as a chart shows it: control characters become blanks, what is not UTF-8 or not allowed in XML U+FFFD.
[[nodiscard]] std::string chart_text(const std::string& text);

// That in an element of XML or HTML.
[[nodiscard]] std::string xml_text(const std::string& text);

// chart_text as gnuplot's double-quoted string. All but letters, digits and plain punctuation is written in octal, so that
// gnuplot finds nothing in it to substitute.
[[nodiscard]] std::string gnuplot_quoted(const std::string& text);

}  // namespace weaveform
