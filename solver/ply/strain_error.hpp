// What model.yarn_stiffness_scale costs: a yarn that is softer than its card stretches further for the same force. With
// e the strain of a yarn under the scaled law and e' that of the card's under the same force N,
//   N = s(e) A(e) = s'(e') A(e') ,    error = e - e' .
#pragma once

#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// MPa; force over the rest section, N/A0.
[[nodiscard]] double nominal_stress(const TangentLaw& law, double strain, bool constant_section);
// 1; the true strain at which `law` bears the nominal stress (MPa), torn_strain (reach.hpp) at most.
[[nodiscard]] double strain_under(const TangentLaw& law, double nominal, bool constant_section);

// Greatest |e - e'| of the yarns under tension, whose true strains are given in the mesh's order; 0 when the scale
// is 1.
[[nodiscard]] double yarn_strain_error(const Mesh& mesh, const Card& card, const ModelSpec& model,
                                       const std::vector<double>& strain);

}  // namespace weaveform
