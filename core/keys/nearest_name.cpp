#include "core/keys/nearest_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/files/text_words.hpp"

namespace weaveform {

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Rows of the classic table, d[i][j] = distance between the first i letters of a and the first j of b; three suffice.
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + changed});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& valid) {
  if (valid.empty()) return "";
  const std::string word = lower(wrong);
  const auto distance = [&](const std::string& name) { return edit_distance(word, lower(name)); };
  const auto nearest = std::min_element(
      valid.begin(), valid.end(), [&](const auto& one, const auto& other) { return distance(one) < distance(other); });
  // Beyond about half the letters a guess is noise: show everything instead.
  const std::size_t near_enough = std::max<std::size_t>(2, std::max(word.size(), nearest->size()) / 2);
  if (distance(*nearest) <= near_enough) return fmt::format("; did you mean '{}'?", *nearest);
  return fmt::format("; valid: {}", fmt::join(valid, ", "));
}

}  // namespace weaveform
