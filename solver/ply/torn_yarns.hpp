// Yarns pulled further than their card allows (fabric/card/card.hpp).
//
// A card limits the strain of its own law, but what breaks a yarn is the force: with model.yarn_stiffness_scale, or
// another law than the card's, a yarn bears the same nominal stress s e^-e (s, where the section keeps constant) at
// another strain. Limits are those strains of the model's law.
#pragma once

#include <array>
#include <string>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct YarnLimits {
  std::array<double, 2> valid_to, tearing;  // 1; true strain of warp and weft in the model's law, torn_strain at most
};
[[nodiscard]] YarnLimits yarn_limits(const Card& card, const ModelSpec& model);

// "the warp yarn between nodes 12 and 13 at (1.5, 20, 0) mm": nodes as the whole mesh's files number them, the place
// on the flat blank.
[[nodiscard]] std::string yarn_place(const Mesh& mesh, int element);

}  // namespace weaveform
