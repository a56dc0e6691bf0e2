#include "solver/ply/torn_yarns.hpp"

#include <fmt/format.h>

#include "solver/element/yarn_law.hpp"
#include "solver/ply/reach.hpp"
#include "solver/ply/strain_error.hpp"

namespace weaveform {

YarnLimits yarn_limits(const Card& card, const ModelSpec& model) {
  const auto laws = yarn_laws(card, model);
  const bool constant_section = model.section == Section::constant;
  YarnLimits limits{};
  for (std::size_t f = 0; f < laws.size(); ++f) {
    const YarnCard& yarn = card.yarn[f];
    const auto in_model = [&](double strain) {
      if (!(strain < torn_strain)) return torn_strain;
      return strain_under(laws[f], nominal_stress(yarn.tension, strain, constant_section), constant_section);
    };
    limits.valid_to[f] = in_model(yarn.valid_to);
    limits.tearing[f] = in_model(yarn.tearing_strain);
  }
  return limits;
}

std::string yarn_place(const Mesh& mesh, int element) {
  const auto [a, b] = mesh.yarns.node[element];
  const auto &from = mesh.nodes.position[a], &to = mesh.nodes.position[b];
  return fmt::format("the {} yarn between nodes {} and {} at ({:.4g}, {:.4g}, {:.4g}) mm",
                     mesh.yarns.family[element] == Family::warp ? "warp" : "weft", mesh.shown_node(a),
                     mesh.shown_node(b), 0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]), 0.5 * (from[2] + to[2]));
}

}  // namespace weaveform
