// The stress of a yarn over the whole line of true strain e, as one tangent law (MPa, times
// model.yarn_stiffness_scale):
//
//   e > 0, model.yarn_law   card     Table 2: the yarn decrimps as it stretches
//                           linear   the card's linear modulus E from zero strain on
//                           slack    nothing up to the slack strain e0, then s = E (e - e0): the crimp is taken up
//                                    without force. e0 = model.slack, or ln(1 + crimp) of the card's family: a yarn
//                                    that is (1 + crimp) times as long as its fabric is straight at that stretch
//   e < 0, model.yarn       truss    the card's compression law: s(e) = -integral_0^|e| C
//                                    or model.compression_modulus e
//                           seatbelt nothing (LS-DYNA's seatbelt of the paper: no compression, slack allowed), or the
//                                    compression law of the partner element beside it (model.partner)
// Seatbelt and partner join the same two nodes with the same section, and where one carries the other carries nothing,
// so that the sum of their forces is one law. The partner alone is partner_law().
#pragma once

#include <array>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Warp and weft. The pieces begin at -infinity and end with the card's own last one.
[[nodiscard]] std::array<TangentLaw, 2> yarn_laws(const Card& card, const ModelSpec& model);

// The compression-only partner: the card's compression law below zero strain, zero above.
[[nodiscard]] TangentLaw partner_law(const YarnCard& yarn, const ModelSpec& model);

// Strain that a yarn of the "slack" law stretches before it carries.
[[nodiscard]] double slack_strain(const YarnCard& yarn, const ModelSpec& model);

}  // namespace weaveform
