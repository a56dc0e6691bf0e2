// How large a mesh will be, from its outline and spacing alone: before anything of that size is made.
#pragma once

#include <array>
#include <string>

#include "fabric/card/card.hpp"
#include "mesher/outline/blank_outline.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct ExpectedSize {
  double cells = 0.0;                          // of the whole blank, about: its area over that of a cell
  double crossings = 0.0;                      // of all lines across its bounding box, blank or not
  std::array<double, 2> extent = {0.0, 0.0};   // mm; of the box, along the blank's own axes
  std::array<double, 2> spacing = {0.0, 0.0};  // mm; along warp and weft
  // A corner without which the box would be a small part of this one, as "blank.csv:12 (3, 1e+06)"; "" for none.
  std::string outlier;
};

// `outline` is that of `blank`.
[[nodiscard]] ExpectedSize expected_size(const BlankSpec& blank, const Card& card, const BlankOutline& outline);

}  // namespace weaveform
