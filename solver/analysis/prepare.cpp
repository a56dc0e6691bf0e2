#include "solver/analysis/prepare.hpp"

#include "solver/bending/flexure.hpp"

namespace weaveform {

Resolved with_scaled_mass(Resolved model) {
  for (double& mass : model.mesh.nodes.mass) mass *= model.scene.analysis.mass_scale;
  for (Resolved& ply : model.ply) ply = with_scaled_mass(std::move(ply));
  return model;
}

std::vector<SymmetricPart> parts_to_solve(const Resolved& model) {
  std::vector<SymmetricPart> parts;
  if (model.symmetry.plane.empty()) return parts;
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    parts.push_back(cut_part(ply.mesh, ply.symmetry, choose_flexure(ply.card, ply.scene).bends_yarns));
  }
  return parts;
}

}  // namespace weaveform
