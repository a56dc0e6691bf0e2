#include "solver/constraint/ties.hpp"

namespace weaveform {

Ties::Ties(const Mesh& mesh, PackedMesh& packed) {
  const auto at = [&](int n) { return packed.packed_of_mesh[n]; };
  for (const auto& tie : mesh.tie) {
    tie_.push_back({at(tie.node), at(tie.to[0]), at(tie.to[1]), tie.share});
    double& mass = packed.mass[at(tie.node)];
    const double share = tie.share < 0.0 ? 0.0 : tie.share;
    packed.mass[at(tie.to[0])] += (1.0 - share) * mass;
    packed.mass[at(tie.to[1])] += share * mass;
    mass = 0.0;
  }
}

void Ties::give_forces(State& state) const {
  for (auto& force : state.force)
    for (const auto& tie : tie_) {
      force[tie.first] += (1.0 - tie.share) * force[tie.node];
      force[tie.second] += tie.share * force[tie.node];
      force[tie.node] = 0.0;
    }
}

void Ties::follow(State& state) const {
  for (int c = 0; c < 3; ++c)
    for (auto* field : {&state.position[c], &state.velocity[c]})
      for (const auto& tie : tie_)
        (*field)[tie.node] = (1.0 - tie.share) * (*field)[tie.first] + tie.share * (*field)[tie.second];
}

TieWeights tie_weights(double share) {
  if (share >= 0.0) return {1.0 - share, share};
  const double l = -share;
  return {(1.0 + 2.0 * l) * (1.0 + l), (1.0 + 2.0 * l) * l};
}

void add_packed_bound(const Mesh& mesh, const PackedMesh& packed, const Doubles& sum, std::vector<double>& bound) {
  for (int n = 0; n < mesh.node_count(); ++n) bound[n] += sum[packed.packed_of_mesh[n]];
  for (const auto& tie : mesh.tie) {
    const TieWeights weight = tie_weights(tie.share);
    bound[tie.to[0]] += weight.first * sum[packed.packed_of_mesh[tie.node]];
    bound[tie.to[1]] += weight.second * sum[packed.packed_of_mesh[tie.node]];
  }
}

}  // namespace weaveform
