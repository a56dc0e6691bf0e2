// What a person typed into a card that a fit is about to replace: bending, limits, what no test of this fit measures.
// It goes into the new card, and what cannot is said, so that nothing typed is lost in silence.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/material/card_schema.hpp"

namespace weaveform::identify {

struct CardParts {
  std::array<YarnFile, 2> yarn;  // warp, weft
  BendingCard bending;
};

// Keys of the yarns and of [bending] that `replaced` (the text of a card file) has and `parts` lack are taken over. One
// line each for what was, and for values that the fit does not measure and gives otherwise. A text that is no card
// gives one line and nothing else.
[[nodiscard]] std::vector<std::string> carry_typed_parts(const std::string& replaced, CardParts& parts);

}  // namespace weaveform::identify
