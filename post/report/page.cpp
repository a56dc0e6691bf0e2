#include "post/report/page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/chart/chart_text.hpp"
#include "core/version/version.hpp"
#include "post/report/viewer.hpp"

namespace weaveform {
namespace {

// Inside a script element nothing may look like its end, or like the beginning of a comment.
std::string inside_script(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string report_page(const nlohmann::ordered_json& data) {
  using Json = nlohmann::ordered_json;
  // names of foreign files may be in any encoding
  const std::string json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string page = fmt::format("{}: {} -->\n", report_mark, version_line());
  page += "<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  page += fmt::format("<title>{}</title>\n<style>", xml_text(data.value("title", "")));
  page += viewer_styles();
  page +=
      "</style>\n</head>\n<body>\n<main id=\"report\"><noscript>This report is drawn by a script that is in it; allow "
      "scripts for this file.</noscript></main>\n<script type=\"application/json\" id=\"weaveform-data\">";
  page += inside_script(json);
  page += "</script>\n<script>";
  page += viewer_script();
  page += "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace weaveform
