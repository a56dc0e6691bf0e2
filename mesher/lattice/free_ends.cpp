#include "mesher/lattice/free_ends.hpp"

#include <array>

namespace weaveform::lattice {

namespace {

// Of one family, the elements that start and that stop at a node; -1: none.
std::vector<std::array<int, 2>> elements_at_nodes(const Mesh& mesh, Family family) {
  std::vector<std::array<int, 2>> at(mesh.node_count(), {-1, -1});
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    if (mesh.yarns.family[e] != family) continue;
    at[mesh.yarns.node[e][0]][0] = e;
    at[mesh.yarns.node[e][1]][1] = e;
  }
  return at;
}

}  // namespace

void tie_free_ends(Mesh& mesh, const std::vector<Hold>& hold) {
  for (const Family family : {Family::warp, Family::weft}) {
    const auto at = elements_at_nodes(mesh, family);
    for (int n = 0; n < mesh.node_count(); ++n) {
      const auto [starts, stops] = at[n];
      const bool is_end = mesh.nodes.crossing[n][0] < 0 && (starts < 0) != (stops < 0);
      if (!is_end || hold[n] != Hold::free) continue;
      const int element = starts >= 0 ? starts : stops;
      const int crossing = mesh.yarns.node[element][starts >= 0 ? 1 : 0];
      const int beyond = at[crossing][starts >= 0 ? 0 : 1];  // the element on the crossing's other side
      if (beyond < 0) continue;
      const int before = mesh.yarns.node[beyond][starts >= 0 ? 1 : 0];
      if (mesh.nodes.crossing[before][0] < 0) continue;
      mesh.tie.push_back({n, {crossing, before}, -mesh.yarns.rest_length[element] / mesh.yarns.rest_length[beyond]});
      mesh.yarns.softening[element] = 0.0;
    }
  }
}

}  // namespace weaveform::lattice
