#include "solver/result/stack_fields.hpp"

#include "mesher/mesh/stack.hpp"

namespace weaveform {

Fields compute_fields(const Resolved& model, double time, const std::vector<Vec3>& position) {
  if (model.ply.empty()) return compute_fields(model.mesh, model.card, model.scene.model, time, position);
  Fields all;
  all.time = time;
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const Resolved& ply = model.ply[k];
    const Range nodes = nodes_of_ply(model.mesh, k);
    append(all, compute_fields(ply.mesh, ply.card, ply.scene.model, time,
                               {position.begin() + nodes.first, position.begin() + nodes.last}));
  }
  return all;
}

}  // namespace weaveform
