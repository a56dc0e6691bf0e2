// Words and numbers of a text line, strictly read.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace weaveform {

// The whole word must be the number. Nothing is wrong when the answer is empty; else it says what, as "'x' is no ...".
[[nodiscard]] std::string read_whole(std::string_view word, long& value);
// As above; finite and within 1e30. Fortran's exponents (1.5D+02) are read too.
[[nodiscard]] std::string read_real(std::string_view word, double& value);

[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line);                   // at blanks
[[nodiscard]] std::vector<std::string_view> fields_of(std::string_view line, char separator);  // trimmed
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string upper(std::string_view text);
[[nodiscard]] std::string lower(std::string_view text);

}  // namespace weaveform
