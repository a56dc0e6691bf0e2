// Texts as charts and pages show them.
#pragma once

#include <string>

namespace weaveform {

// In one line of UTF-8: control characters become blanks, what is not UTF-8 or not allowed in XML U+FFFD.
[[nodiscard]] std::string chart_text(const std::string& text);

// That in an element of XML or HTML.
[[nodiscard]] std::string xml_text(const std::string& text);

}  // namespace weaveform
