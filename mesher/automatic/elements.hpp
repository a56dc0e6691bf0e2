// The cheapest elements that serve: bending where fabric is pressed without support or where the scene asks for it,
// yarns that bend in the plane where the load has no limit without.
#pragma once

#include <string>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Nothing pushes or pulls the fabric out of its plane.
[[nodiscard]] bool is_flat(const Scene& scene);

// Held by grips at two places or more, so that tools stretch it.
[[nodiscard]] inline bool is_stretched(const Scene& scene) {
  return !scene.tools.empty() && scene.grip.size() >= 2;
}

// Pulled yarns that stretch so little that zones end in a jump on any mesh: no card's decrimping, or stiffened.
[[nodiscard]] inline bool hardly_stretches(const ModelSpec& model) {
  return model.yarn_law != YarnLaw::card || model.yarn_stiffness_scale > 1.0;
}

struct TakenElement {
  std::string why;     // one line
  std::string missed;  // what the card lacks; "" when nothing
};

// Set scene.model.yarn or scene.model.cell.
[[nodiscard]] TakenElement take_yarn(Scene& scene, const Card& card);
[[nodiscard]] TakenElement take_cell(Scene& scene, const Card& card);

}  // namespace weaveform
