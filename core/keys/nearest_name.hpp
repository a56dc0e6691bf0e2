// The valid name a user most likely meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace weaveform {

// Least number of insertions, deletions, substitutions and swaps of neighbours that turns one word into the other
// (optimal string alignment; Damerau 1964).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// "; did you mean 'size'?", or every valid name when none is near, or "" when there is none. Ends a complaint.
[[nodiscard]] std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& valid);

}  // namespace weaveform
