#include "solver/bending/bends.hpp"

#include <cmath>

namespace weaveform {
namespace {

// Elements of one family that stop and that start at each node; -1: none.
struct Neighbours {
  std::vector<int> before, after;
};

Neighbours neighbours(const Mesh& mesh, Family family) {
  Neighbours at{std::vector<int>(mesh.node_count(), -1), std::vector<int>(mesh.node_count(), -1)};
  std::vector<char> free_end(mesh.node_count(), 0);
  for (const auto& tie : mesh.tie) free_end[tie.node] = tie.share < 0.0 ? 1 : 0;
  for (const auto& image : mesh.symmetry.image) free_end[image.node] = free_end[image.of];
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    if (mesh.yarns.family[e] != family || free_end[a] != 0 || free_end[b] != 0) continue;
    at.after[a] = e;
    at.before[b] = e;
  }
  return at;
}

Vec3 direction(const Mesh& mesh, int element) {
  const auto [a, b] = mesh.yarns.node[element];
  const Vec3 &x = mesh.nodes.position[a], &y = mesh.nodes.position[b];
  const double length = std::hypot(y[0] - x[0], y[1] - x[1], y[2] - x[2]);
  return {(y[0] - x[0]) / length, (y[1] - x[1]) / length, (y[2] - x[2]) / length};
}

YarnBend plain_bend(const Mesh& mesh, int node, int before, int after) {
  YarnBend bend{.before = node, .after = node};
  if (before >= 0) bend.before = mesh.yarns.node[before][0];
  if (after >= 0) bend.after = mesh.yarns.node[after][1];
  if (before < 0 || after < 0) return bend;
  bend.yarns = 0.5 * (mesh.yarns.yarns[before] + mesh.yarns.yarns[after]);
  bend.spread = 0.5 * (mesh.yarns.rest_length[before] + mesh.yarns.rest_length[after]);
  return bend;
}

// The yarn leaves the jaws along its first direction.
YarnBend clamped_bend(const Mesh& mesh, int node, int element, bool leaves) {
  YarnBend bend{.before = node, .after = node};
  (leaves ? bend.after : bend.before) = mesh.yarns.node[element][leaves ? 1 : 0];
  (leaves ? bend.fixed_before : bend.fixed_after) = true;
  bend.fixed = direction(mesh, element);
  bend.yarns = mesh.yarns.yarns[element];
  bend.spread = 0.5 * mesh.yarns.rest_length[element];
  return bend;
}

}  // namespace

std::vector<Bend> find_bends(const Mesh& mesh, const std::vector<char>& held) {
  const std::array<Neighbours, 2> at = {neighbours(mesh, Family::warp), neighbours(mesh, Family::weft)};
  std::vector<Bend> bends;
  const std::vector<double> share = node_share(mesh.symmetry, mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (share[n] == 0.0) continue;  // beyond a mirror plane
    if (held[n] == 0) {
      const Bend bend{
          n,
          {plain_bend(mesh, n, at[0].before[n], at[0].after[n]), plain_bend(mesh, n, at[1].before[n], at[1].after[n])}};
      if (bend.yarn[0].yarns > 0.0 || bend.yarn[1].yarns > 0.0) bends.push_back(bend);
      continue;
    }
    for (int f = 0; f < 2; ++f)
      for (const bool leaves : {true, false}) {
        const int element = leaves ? at[f].after[n] : at[f].before[n];
        if (element < 0 || held[mesh.yarns.node[element][leaves ? 1 : 0]] != 0) continue;
        // the other family only tells where the fabric's plane is
        const int g = 1 - f;
        Bend bend{n, {}};
        bend.yarn[f] = clamped_bend(mesh, n, element, leaves);
        bend.yarn[g] = plain_bend(mesh, n, at[g].before[n], at[g].after[n]);
        bend.yarn[g].yarns = 0.0;
        bends.push_back(bend);
      }
  }
  for (auto& bend : bends)
    for (auto& yarn : bend.yarn) yarn.yarns *= share[bend.node];
  return bends;
}

}  // namespace weaveform
