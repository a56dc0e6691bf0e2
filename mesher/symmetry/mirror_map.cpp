#include "mesher/symmetry/mirror_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

double height(const SymmetryPlane& plane, const Vec3& x) {
  return dot(minus(x, plane.point), plane.normal);
}

bool alike(double a, double b) {
  return std::abs(a - b) <= mirror_value_tolerance * std::max(std::abs(a), std::abs(b));
}

std::string words_of(const Mesh& mesh, int node) {
  const auto& x = mesh.nodes.position[node];
  return fmt::format("node {} at ({:.6g}, {:.6g}, {:.6g}) mm", node, x[0], x[1], x[2]);
}

// Nodes in square buckets, to be found by their place in the plane of the blank.
class Places {
public:
  Places(const std::vector<Vec3>& position, double side) : position_(position), side_(side) {
    std::array<double, 2> high = {position.front()[0], position.front()[1]};
    low_ = high;
    for (const auto& x : position)
      for (std::size_t c = 0; c < 2; ++c) {
        low_[c] = std::min(low_[c], x[c]);
        high[c] = std::max(high[c], x[c]);
      }
    for (std::size_t c = 0; c < 2; ++c) count_[c] = static_cast<int>((high[c] - low_[c]) / side_) + 1;
    bucket_.resize(static_cast<std::size_t>(count_[0]) * count_[1]);
    for (std::size_t n = 0; n < position.size(); ++n)
      bucket_[index(column(position[n], 0), column(position[n], 1))].push_back(static_cast<int>(n));
  }
  // The node within `tolerance` of a place; -1: none.
  [[nodiscard]] int at(const Vec3& x, double tolerance) const {
    const int i = column(x, 0), j = column(x, 1);
    for (int b = std::max(0, j - 1); b <= std::min(count_[1] - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(count_[0] - 1, i + 1); ++a)
        for (const int n : bucket_[index(a, b)]) {
          const Vec3 off = minus(position_[n], x);
          if (dot(off, off) <= tolerance * tolerance) return n;
        }
    return -1;
  }

private:
  [[nodiscard]] int column(const Vec3& x, std::size_t axis) const {
    return static_cast<int>(std::floor((x[axis] - low_[axis]) / side_));
  }
  [[nodiscard]] std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * count_[0] + i; }
  const std::vector<Vec3>& position_;
  double side_;
  std::array<double, 2> low_{};
  std::array<int, 2> count_{};
  std::vector<std::vector<int>> bucket_;
};

std::string map_nodes(const Mesh& mesh, const SymmetryPlane& plane, double tolerance, std::vector<int>& image) {
  const Places places(mesh.nodes.position, std::min(mesh.spacing[0], mesh.spacing[1]));
  image.resize(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto& x = mesh.nodes.position[n];
    const int m = places.at(mirrored_point(x, plane), tolerance);
    if (m < 0) return words_of(mesh, n) + " has no mirror image: the yarn lattice is not symmetric";
    image[n] = m;
    if (std::abs(height(plane, x)) <= tolerance && m != n)
      return words_of(mesh, n) + " lies beside another one in the plane";
  }
  return "";
}

std::string compare_masses(const Mesh& mesh, const std::vector<int>& image) {
  for (int n = 0; n < mesh.node_count(); ++n) {
    const double mass = mesh.nodes.mass[n], other = mesh.nodes.mass[image[n]];
    if (!alike(mass, other))
      return fmt::format("{} has {:.6g} tonne, its mirror image {:.6g}", words_of(mesh, n), mass, other);
  }
  return "";
}

// The image of a family's direction: which family's it is, and with which sign; family -1: none's.
struct FamilyImage {
  int family = -1;
  double sign = 1.0;
};

using Directions = std::array<Vec3, 2>;

Directions yarn_directions(const Mesh& mesh) {
  Directions along{};
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    Vec3 d = minus(mesh.nodes.position[b], mesh.nodes.position[a]);
    const double length = std::sqrt(dot(d, d));
    for (auto& component : d) component /= length;
    along[static_cast<std::size_t>(mesh.yarns.family[e])] = d;
  }
  return along;
}

FamilyImage image_of(const Vec3& mirrored, const Directions& along) {
  for (int f = 0; f < 2; ++f) {
    const double cosine = dot(mirrored, along[f]);
    if (std::abs(cosine) > 1.0 - 1e-9) return {f, cosine > 0.0 ? 1.0 : -1.0};
  }
  return {};
}

// Elements or cells at each node.
using Around = std::vector<std::vector<int>>;

bool yarns_alike(const MeshYarns& yarns, int e, int image, bool swapped) {
  const bool same_family = yarns.family[e] == yarns.family[image];
  return same_family != swapped && alike(yarns.rest_length[e], yarns.rest_length[image]) &&
         alike(yarns.section[e], yarns.section[image]) && alike(yarns.yarns[e], yarns.yarns[image]) &&
         alike(yarns.rest_length[e] + yarns.jaw[e], yarns.rest_length[image] + yarns.jaw[image]) &&
         alike(yarns.softening[e], yarns.softening[image]);
}

std::string map_yarns(const Mesh& mesh, MirrorMap& map) {
  Around around(mesh.node_count());
  for (int e = 0; e < mesh.yarn_count(); ++e)
    for (const int n : mesh.yarns.node[e]) around[n].push_back(e);
  map.yarn.assign(mesh.yarn_count(), -1);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    const int p = map.node[a], q = map.node[b];
    for (const int other : around[p]) {
      const auto [c, d] = mesh.yarns.node[other];
      const bool same_ends = (c == p && d == q) || (c == q && d == p);
      if (same_ends && yarns_alike(mesh.yarns, e, other, map.swaps_families)) map.yarn[e] = other;
    }
    if (map.yarn[e] < 0) return fmt::format("the yarn element at {} has none like it opposite", words_of(mesh, a));
  }
  return "";
}

// c'[f'][m(a)] = sign_f c[f][a]: the directions of a cell's image are the images of its directions.
bool cells_alike(const Mesh& mesh, int cell, int other, const std::vector<int>& node,
                 const std::array<FamilyImage, 2>& family, double scale) {
  const auto& cells = mesh.cells;
  const int begin = cells.offset[cell], end = cells.offset[cell + 1];
  const int from = cells.offset[other], to = cells.offset[other + 1];
  if (end - begin != to - from || !alike(cells.area[cell], cells.area[other])) return false;
  for (int a = begin; a < end; ++a) {
    const auto at = std::find(cells.node.begin() + from, cells.node.begin() + to, node[cells.node[a]]);
    if (at == cells.node.begin() + to) return false;
    const auto& found = cells.coefficient[static_cast<std::size_t>(at - cells.node.begin())];
    for (std::size_t f = 0; f < 2; ++f)
      if (std::abs(found[family[f].family] - family[f].sign * cells.coefficient[a][f]) > scale) return false;
  }
  return true;
}

std::string map_cells(const Mesh& mesh, const std::array<FamilyImage, 2>& family, MirrorMap& map) {
  const double scale = mirror_value_tolerance / std::min(mesh.spacing[0], mesh.spacing[1]);
  Around around(mesh.node_count());
  for (int c = 0; c < mesh.cells.size(); ++c)
    for (int a = mesh.cells.offset[c]; a < mesh.cells.offset[c + 1]; ++a) around[mesh.cells.node[a]].push_back(c);
  map.cell.assign(mesh.cells.size(), -1);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int first = mesh.cells.node[mesh.cells.offset[c]];
    for (const int other : around[map.node[first]])
      if (cells_alike(mesh, c, other, map.node, family, scale)) map.cell[c] = other;
    if (map.cell[c] < 0) return fmt::format("the cell at {} has none like it opposite", words_of(mesh, first));
  }
  return "";
}

std::string check_ties(const Mesh& mesh, const MirrorMap& map) {
  std::vector<int> tie_at(mesh.node_count(), -1);
  for (std::size_t t = 0; t < mesh.tie.size(); ++t) tie_at[mesh.tie[t].node] = static_cast<int>(t);
  for (const auto& tie : mesh.tie) {
    const int other = tie_at[map.node[tie.node]];
    const bool like = other >= 0 && mesh.tie[other].to[0] == map.node[tie.to[0]] &&
                      mesh.tie[other].to[1] == map.node[tie.to[1]] && alike(mesh.tie[other].share, tie.share);
    if (!like) return fmt::format("the yarn end at {} is not tied like its mirror image", words_of(mesh, tie.node));
  }
  return "";
}

std::string map_sets(const Mesh& mesh, MirrorMap& map) {
  map.set.assign(mesh.sets.size(), -1);
  for (std::size_t s = 0; s < mesh.sets.size(); ++s) {
    std::vector<int> image;
    for (const int n : mesh.sets[s].node) image.push_back(map.node[n]);
    std::sort(image.begin(), image.end());
    for (std::size_t t = 0; t < mesh.sets.size(); ++t)
      if (mesh.sets[t].node == image) map.set[s] = static_cast<int>(t);
    if (map.set[s] < 0)
      return fmt::format("the nodes held by '{}' have no mirror image that is held", mesh.sets[s].name);
  }
  return "";
}

}  // namespace

std::string find_mirror_map(const Mesh& mesh, const SymmetryPlane& plane, MirrorMap& map) {
  map = {};
  const double tolerance = mirror_place_tolerance * std::min(mesh.spacing[0], mesh.spacing[1]);
  const Directions along = yarn_directions(mesh);
  const std::array<FamilyImage, 2> family = {image_of(mirrored_vector(along[0], plane), along),
                                             image_of(mirrored_vector(along[1], plane), along)};
  if (family[0].family < 0 || family[1].family < 0)
    return "the yarns do not run along it, across it or at 45 deg to it";
  map.swaps_families = family[0].family == 1;
  if (map.swaps_families && !alike(mesh.spacing[0], mesh.spacing[1]))
    return fmt::format("it swaps warp and weft, which lie {:.6g} and {:.6g} mm apart", mesh.spacing[1],
                       mesh.spacing[0]);
  std::string why = map_nodes(mesh, plane, tolerance, map.node);
  if (why.empty()) why = map_sets(mesh, map);
  if (why.empty()) why = compare_masses(mesh, map.node);
  if (why.empty()) why = map_yarns(mesh, map);
  if (why.empty()) why = map_cells(mesh, family, map);
  if (why.empty()) why = check_ties(mesh, map);
  return why;
}

}  // namespace weaveform
