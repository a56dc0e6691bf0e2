#include "solver/bending/bends.hpp"

#include <cmath>

namespace weaveform {
namespace {

// Elements of one family that stop and that start at each node; -1: none.
struct Neighbours {
  std::vector<int> before, after;
};

// Per node, whether it is a free yarn end that is tied in line with its yarn.
std::vector<char> free_ends(const Mesh& mesh) {
  std::vector<char> free_end(mesh.node_count(), 0);
  for (const auto& tie : mesh.tie) free_end[tie.node] = tie.share < 0.0 ? 1 : 0;
  for (const auto& image : mesh.symmetry.image) free_end[image.node] = free_end[image.of];
  return free_end;
}

Neighbours neighbours(const Mesh& mesh, Family family) {
  Neighbours at{std::vector<int>(mesh.node_count(), -1), std::vector<int>(mesh.node_count(), -1)};
  const std::vector<char> free_end = free_ends(mesh);
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
  const std::vector<char> free_end = free_ends(mesh);
  std::vector<double> length(mesh.node_count(), 0.0);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    if (mesh.yarns.family[e] != family) continue;
    if (free_end[a] != 0) length[b] += mesh.yarns.rest_length[e];
    if (free_end[b] != 0) length[a] += mesh.yarns.rest_length[e];
  }
  return length;
}

// One way along a yarn from a node: of a family, onwards or back.
struct YarnWay {
  int node = 0;
  int family = 0;
  bool after = true;
};

// Ways from nodes beyond a mirror plane as those of the nodes that they are images of, about which the mesh knows all.
class RealWays {
public:
  explicit RealWays(const Mesh& mesh) : symmetry_(mesh.symmetry), image_(mesh.node_count(), -1) {
    for (std::size_t k = 0; k < symmetry_.image.size(); ++k) image_[symmetry_.image[k].node] = static_cast<int>(k);
    for (int e = 0; e < mesh.yarn_count(); ++e)
      direction_[mesh.yarns.family[e] == Family::warp ? 0 : 1] = direction(mesh, e);
  }
  [[nodiscard]] YarnWay operator()(const YarnWay& way) const {
    if (image_[way.node] < 0) return way;
    const MirrorImage& image = symmetry_.image[image_[way.node]];
    Vec3 along = direction_[way.family];
    if (!way.after)
      for (double& component : along) component = -component;
    along = mirrored_vector(along, symmetry_.plane, image.planes);
    const auto part = [&](int f) {
      return along[0] * direction_[f][0] + along[1] * direction_[f][1] + along[2] * direction_[f][2];
    };
    const int family = std::abs(part(0)) > std::abs(part(1)) ? 0 : 1;
    return {image.of, family, part(family) > 0.0};
  }

private:
  const MeshSymmetry& symmetry_;
  std::vector<int> image_;         // per node; -1: none
  std::array<Vec3, 2> direction_;  // of the flat families
};

bool goes_on(const std::array<Neighbours, 2>& at, const YarnWay& way) {
  return (way.after ? at[way.family].after : at[way.family].before)[way.node] >= 0;
}

// Whether an edge across the family alone passes the end of one of its yarns: the yarns beside it end there too.
bool cut_across(const Mesh& mesh, const std::array<Neighbours, 2>& at, const RealWays& real, const YarnWay& end) {
  const int g = 1 - end.family;
  for (const bool up : {true, false}) {
    const int element = up ? at[g].after[end.node] : at[g].before[end.node];
    if (element < 0) continue;
    const int beside = mesh.yarns.node[element][up ? 1 : 0];
    if (goes_on(at, real({beside, end.family, end.after}))) return false;
  }
  return true;
}

// Where the yarn ends beside a bend at an edge oblique to it, the bend bears the energy of what is beyond it: half an
// element and a free end.
void reach_to_ends(const Mesh& mesh, const std::array<Neighbours, 2>& at, std::vector<Bend>& bends,
                   const std::vector<char>& held) {
  const std::array<std::vector<double>, 2> beyond = {free_lengths(mesh, Family::warp),
                                                     free_lengths(mesh, Family::weft)};
  const RealWays real(mesh);
  for (int f = 0; f < 2; ++f)
    for (auto& bend : bends) {
      YarnBend& yarn = bend.yarn[f];
      if (yarn.yarns == 0.0) continue;
      double reach = 0.0;
      for (const bool after : {true, false}) {
        if (after ? yarn.fixed_after : yarn.fixed_before) continue;
        const int neighbour = after ? yarn.after : yarn.before;
        const YarnWay end = real({neighbour, f, after});
        if (neighbour == bend.node || held[end.node] != 0 || goes_on(at, end) || cut_across(mesh, at, real, end))
          continue;
        const int element = after ? at[f].after[bend.node] : at[f].before[bend.node];
        reach += 0.5 * mesh.yarns.rest_length[element] + beyond[end.family][end.node];
      }
      yarn.yarns *= 1.0 + reach / yarn.spread;
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
  reach_to_ends(mesh, at, bends, held);
  for (auto& bend : bends)
    for (auto& yarn : bend.yarn) yarn.yarns *= share[bend.node];
  return bends;
}

}  // namespace weaveform
