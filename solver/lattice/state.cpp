#include "solver/lattice/state.hpp"

namespace weaveform {

State initial_state(const PackedMesh& packed, const Mesh& mesh) {
  State state;
  for (int c = 0; c < 3; ++c) {
    state.position[c].assign(packed.nodes, 0.0);
    state.velocity[c].assign(packed.nodes, 0.0);
    state.force[c].assign(packed.nodes, 0.0);
    for (int n = 0; n < mesh.node_count(); ++n) state.position[c][packed.packed_of_mesh[n]] = mesh.nodes.position[n][c];
  }
  return state;
}

std::vector<std::array<double, 3>> mesh_positions(const PackedMesh& packed, const State& state) {
  std::vector<std::array<double, 3>> result(packed.packed_of_mesh.size());
  for (std::size_t n = 0; n < result.size(); ++n)
    for (int c = 0; c < 3; ++c) result[n][c] = state.position[c][packed.packed_of_mesh[n]];
  return result;
}

}  // namespace weaveform
