// Bisection between a value where a method holds and one where it fails, replayed from what is known: the same answers
// lead to the same search, whatever was interrupted in between.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/study/border_spec.hpp"

namespace weaveform::study {

struct BorderSearch {
  double holds = 0.0, fails = 0.0;  // the bracket so far
  std::vector<double> tried;        // in the order in which they were wanted, both ends first
  std::vector<double> wanted;       // values whose answer is needed to go on; empty: the search has ended
  std::string complaint;            // why there is no border; "" when there is one, or the search goes on
};

// Whether the method holds at a value; nothing when that is not known yet.
using HoldsAt = std::function<std::optional<bool>(double)>;

// The bracket is halved until it is within spec.tolerance, or within a millionth of its first width (a linear search
// towards 0 would have no end). Values tried have six digits. A method that holds and fails by turns has several
// borders; one of them is found.
[[nodiscard]] BorderSearch search_border(const BorderSpec& spec, const HoldsAt& holds_at);

// The value between the ends: their mean, or their geometric mean on a logarithmic scale.
[[nodiscard]] double border_between(const BorderSpec& spec, double holds, double fails);

}  // namespace weaveform::study
