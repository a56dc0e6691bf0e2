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

// mm; of one family, the length of a tied free end beyond each node.
std::vector<double> free_lengths(const Mesh& mesh, Family family) {
  std::vector<char> free_end(mesh.node_count(), 0);
  for (const auto& tie : mesh.tie) free_end[tie.node] = tie.share < 0.0 ? 1 : 0;
  std::vector<double> length(mesh.node_count(), 0.0);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    if (mesh.yarns.family[e] != family) continue;
    if (free_end[a] != 0) length[b] += mesh.yarns.rest_length[e];
    if (free_end[b] != 0) length[a] += mesh.yarns.rest_length[e];
  }
  return length;
}

// Whether an edge across family f alone passes the end of one of its yarns: the yarns beside it end there too.
bool cut_across(const Mesh& mesh, const std::array<Neighbours, 2>& at, int end, int f, bool after) {
  const int g = 1 - f;
  for (const bool up : {true, false}) {
    const int element = up ? at[g].after[end] : at[g].before[end];
    if (element < 0) continue;
    const int beside = mesh.yarns.node[element][up ? 1 : 0];
    if ((after ? at[f].after[beside] : at[f].before[beside]) >= 0) return false;
  }
  return true;
}

// Where the yarn ends beside a bend at an edge oblique to it, the bend bears the energy of what is beyond it: half an
// element and a free end.
void reach_to_ends(const Mesh& mesh, const std::array<Neighbours, 2>& at, std::vector<Bend>& bends,
                   const std::vector<char>& held, const std::vector<double>& share) {
  for (int f = 0; f < 2; ++f) {
    const auto beyond = free_lengths(mesh, f == 0 ? Family::warp : Family::weft);
    for (auto& bend : bends) {
      YarnBend& yarn = bend.yarn[f];
      if (yarn.yarns == 0.0) continue;
      double reach = 0.0;
      for (const bool after : {true, false}) {
        if (after ? yarn.fixed_after : yarn.fixed_before) continue;
        const Neighbours& of_yarn = at[f];
        const int end = after ? yarn.after : yarn.before;
        if (share[end] == 0.0) continue;  // beyond a mirror plane, where the yarn goes on
        if (end == bend.node || held[end] != 0 || (after ? of_yarn.after[end] : of_yarn.before[end]) >= 0) continue;
        if (cut_across(mesh, at, end, f, after)) continue;
        const int element = after ? of_yarn.after[bend.node] : of_yarn.before[bend.node];
        reach += 0.5 * mesh.yarns.rest_length[element] + beyond[end];
      }
      yarn.yarns *= 1.0 + reach / yarn.spread;
    }
  }
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
  reach_to_ends(mesh, at, bends, held, share);
  for (auto& bend : bends)
    for (auto& yarn : bend.yarn) yarn.yarns *= share[bend.node];
  return bends;
}

}  // namespace weaveform
