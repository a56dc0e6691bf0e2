// What charts and tables call a number of summary.json or a column of history.csv: words and a unit, for people.
#pragma once

#include <string>

namespace weaveform {

// A column of history.csv: "punch.force_N" -> "force of punch (N)".
[[nodiscard]] std::string column_in_words(const std::string& column);

// A measure of a study (app/study/measure.hpp): "tools.punch.force_N" -> "force of punch at the end (N)",
// "max(top.force_N)" -> "greatest force of top (N)". A name that nobody foresaw keeps its own words, with its unit.
[[nodiscard]] std::string measure_in_words(const std::string& measure);

}  // namespace weaveform
