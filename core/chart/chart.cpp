#include "core/chart/chart.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/chart/chart_json.hpp"
#include "core/chart/chart_text.hpp"
#include "core/chart/draw_script.hpp"
#include "core/error.hpp"
#include "core/guard/run_program.hpp"

namespace weaveform {
namespace {

// By which a later run knows that the file may be overwritten.
constexpr const char* own_mark = "<!-- Written by weaveform -->\n";

// What node writes to standard output for a script. Neither the user's settings (NODE_OPTIONS, language) nor a shell
// take part.
std::string run_node(const std::string& script) {
  const std::string purpose = "charts cannot be drawn";
  const ProgramEnd end = run_program({"node", "-"}, script, purpose, "nodejs");
  if (end.signal != 0)
    throw FileError(fmt::format("{}: node was ended by signal {} (package nodejs)", purpose, end.signal));
  if (end.exit_code != 0)
    throw FileError(fmt::format("{}: node (package nodejs, 18 or later) ended with exit code {}: {}", purpose,
                                end.exit_code, end.complaint));
  return end.output;
}

// Identifiers are unique among the charts of a page: they begin with `prefix` and the chart's number.
std::vector<std::string> draw(const std::vector<Chart>& charts, const std::string& prefix) {
  nlohmann::ordered_json data = nlohmann::ordered_json::array();
  for (const Chart& chart : charts) {
    const std::string id = prefix.empty() ? "chart" : fmt::format("{}{}", prefix, data.size() + 1);
    auto json = chart_json(id, chart, false, std::numeric_limits<std::size_t>::max());
    json["width"] = chart.width;
    json["height"] = chart.height;
    data.push_back(std::move(json));
  }
  // JSON is JavaScript.
  const std::string output = run_node(fmt::format("{}\n;drawCharts({});\n", draw_script(), data.dump()));
  try {
    auto drawn = nlohmann::json::parse(output).get<std::vector<std::string>>();
    if (drawn.size() == charts.size()) return drawn;
  } catch (const nlohmann::json::exception&) {
    // told below
  }
  throw FileError("charts cannot be drawn: node on the PATH (package nodejs) does not write what it is asked for");
}

}  // namespace

std::vector<std::string> to_svgs(const std::vector<Chart>& charts) {
  return charts.empty() ? std::vector<std::string>{} : draw(charts, "");
}

std::string to_svg(const Chart& chart) {
  return to_svgs({chart}).front();
}

std::string to_html(const std::string& title, const std::vector<Chart>& charts) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n{1}<title>{0}</title>\n"
      "<style>body{{font-family:sans-serif;max-width:70em;margin:2em auto;padding:0 1em}}"
      "figure{{margin:2em 0}}svg{{max-width:100%;height:auto}}figcaption{{color:#404040;max-width:50em}}</style>\n"
      "</head>\n<body>\n<h1>{0}</h1>\n",
      xml_text(title), own_mark);
  const auto svgs = charts.empty() ? std::vector<std::string>{} : draw(charts, "chart");
  for (std::size_t i = 0; i < charts.size(); ++i) {
    page += fmt::format("<figure>\n{}", svgs[i].substr(svgs[i].find("<svg")));
    if (!charts[i].caption.empty()) page += fmt::format("<figcaption>{}</figcaption>\n", xml_text(charts[i].caption));
    page += "</figure>\n";
  }
  return page + "</body>\n</html>\n";
}

}  // namespace weaveform
