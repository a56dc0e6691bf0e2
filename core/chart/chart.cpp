#include "core/chart/chart.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "core/chart/chart_script.hpp"
#include "core/chart/gnuplot.hpp"

namespace weaveform {
namespace {

// By which a later run knows that the file may be overwritten.
constexpr const char* own_mark = "<!-- Written by weaveform -->\n";

// gnuplot names itself and its plots ("gnuplot_plot_1") in <title> elements, which viewers show beside the pointer: the
// chart's title and the series' labels instead.
std::string with_titles(const std::string& svg, const std::string& title, const std::vector<std::string>& labels) {
  constexpr std::string_view open = "<title>", close = "</title>", plot = "gnuplot_plot_";
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = svg.find(open); at != std::string::npos; at = svg.find(open, done)) {
    const std::size_t begin = at + open.size(), end = svg.find(close, begin);
    if (end == std::string::npos) break;
    const std::string name = svg.substr(begin, end - begin);
    out += svg.substr(done, begin - done);
    const std::size_t number = name.starts_with(plot) ? std::stoul(name.substr(plot.size())) : 0;
    out += xml_text(number == 0 ? title : number <= labels.size() ? labels[number - 1] : "");
    done = end;
  }
  return out + svg.substr(done);
}

// Ids are unique within an SVG, not within a page of several. Only tags are changed; a text may hold what looks like
// one.
std::string with_own_ids(const std::string& svg, const std::string& prefix) {
  constexpr std::string_view marks[] = {" id='", " id=\"", "href='#", "href=\"#", "url(#"};
  std::string out;
  bool in_tag = false;
  for (std::size_t i = 0; i < svg.size();) {
    if (svg[i] == '<') in_tag = true;
    if (svg[i] == '>') in_tag = false;
    std::string_view found(svg.data() + i, 1);
    for (const auto mark : marks)
      if (in_tag && svg.compare(i, mark.size(), mark) == 0) found = mark;
    out += found;
    if (found.size() > 1) out += prefix;
    i += found.size();
  }
  return out;
}

}  // namespace

std::string to_svg(const Chart& chart) {
  const ChartScript script = gnuplot_script(chart);
  std::string svg = with_titles(run_gnuplot(script.text), chart.title, script.labels);
  if (const std::size_t begin = svg.find("<svg"); begin != std::string::npos) svg.insert(begin, own_mark);
  return svg;
}

std::string to_html(const std::string& title, const std::vector<Chart>& charts) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{1}<title>{0}</title>\n"
      "<style>body{{font-family:sans-serif;max-width:70em;margin:2em auto;padding:0 1em}}"
      "figure{{margin:2em 0}}svg{{max-width:100%;height:auto}}figcaption{{color:#404040;max-width:50em}}</style>\n"
      "</head>\n<body>\n<h1>{0}</h1>\n",
      xml_text(title), own_mark);
  for (std::size_t i = 0; i < charts.size(); ++i) {
    const std::string svg = to_svg(charts[i]);
    page += fmt::format("<figure>\n{}", with_own_ids(svg.substr(svg.find("<svg")), fmt::format("chart{}_", i + 1)));
    if (!charts[i].caption.empty()) page += fmt::format("<figcaption>{}</figcaption>\n", xml_text(charts[i].caption));
    page += "</figure>\n";
  }
  return page + "</body>\n</html>\n";
}

}  // namespace weaveform
