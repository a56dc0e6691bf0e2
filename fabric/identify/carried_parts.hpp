// What a person typed into a card that a fit is about to replace: bending, limits, what no test of this fit measures.
// It goes into the new card, and what cannot is said, so that nothing typed is lost in silence.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fabric/card/card_schema.hpp"

namespace weaveform::identify {

struct CardParts {
  std::array<YarnFile, 2> yarn;  // warp, weft
  BendingCard bending;
};

// Keys of the yarns and of [bending] that `replaced` (the text of a card file, `file` in messages) has and `parts` lack
// are taken over. One line each for what was, and for values that the fit does not measure and gives otherwise. Throws
// InputError for a text that is no card, which would be lost. `bending_measured`: the fit's tests make the bending laws.
[[nodiscard]] std::vector<std::string> carry_typed_parts(const std::string& replaced, const std::string& file,
                                                         bool bending_measured, CardParts& parts);

}  // namespace weaveform::identify
