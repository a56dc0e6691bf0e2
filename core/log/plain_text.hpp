// Text as instruments and spreadsheets of any country write it, in one form: UTF-8 with '\n' between the lines.
#pragma once

#include <string>

namespace weaveform {

// UTF-16 with or without a byte-order mark, UTF-8, and what is neither as Windows-1252 (which Latin-1 is part of)
// become UTF-8 without a mark. Typographic quotes become plain ones, no-break spaces blanks, the minus sign and dashes
// '-', the Greek mu the micro sign; a lone '\r' ends a line. Lines keep their numbers. What is no text keeps its zero
// bytes.
[[nodiscard]] std::string plain_text(std::string bytes);

}  // namespace weaveform
