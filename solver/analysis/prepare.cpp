#include "solver/analysis/prepare.hpp"

#include "solver/bending/flexure.hpp"

namespace weaveform {

Resolved with_scaled_mass(Resolved model) {
  for (double& mass : model.mesh.nodes.mass) mass *= model.scene.analysis.mass_scale;
  return model;
}

std::optional<SymmetricPart> part_to_solve(const Resolved& model) {
  if (model.symmetry.plane.empty()) return {};
  return cut_part(model.mesh, model.symmetry, choose_flexure(model.card, model.scene.model).bends_yarns);
}

}  // namespace weaveform
