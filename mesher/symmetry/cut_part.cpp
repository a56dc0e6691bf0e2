#include "mesher/symmetry/cut_part.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

// The images of one thing, itself among them, each once.
std::vector<int> orbit(int which, const std::vector<const std::vector<int>*>& maps) {
  std::vector<int> images = {which};
  for (const auto* map : maps)
    for (std::size_t k = 0, count = images.size(); k < count; ++k) images.push_back((*map)[images[k]]);
  std::sort(images.begin(), images.end());
  images.erase(std::unique(images.begin(), images.end()), images.end());
  return images;
}

struct Cutter {
  const Mesh& whole;
  const Symmetry& symmetry;
  double tolerance;  // mm
  SymmetricPart part;
  std::vector<int> part_of_whole;  // -1: not in the part

  Cutter(const Mesh& the_whole, const Symmetry& the_symmetry)
      : whole(the_whole),
        symmetry(the_symmetry),
        tolerance(mirror_place_tolerance * std::min(the_whole.spacing[0], the_whole.spacing[1])),
        part_of_whole(the_whole.node_count(), -1) {}

  // Planes that a place lies beyond, as bits.
  [[nodiscard]] unsigned beyond(const Vec3& x) const {
    unsigned planes = 0;
    for (std::size_t k = 0; k < symmetry.plane.size(); ++k)
      if (height(x, k) < -tolerance) planes |= 1U << k;
    return planes;
  }
  [[nodiscard]] double height(const Vec3& x, std::size_t k) const {
    const auto& [point, normal] = symmetry.plane[k];
    return (x[0] - point[0]) * normal[0] + (x[1] - point[1]) * normal[1] + (x[2] - point[2]) * normal[2];
  }
  [[nodiscard]] std::vector<const std::vector<int>*> maps(std::vector<int> MirrorMap::*of) const {
    std::vector<const std::vector<int>*> list;
    for (const auto& map : symmetry.map) list.push_back(&(map.*of));
    return list;
  }
  template <class Nodes>
  [[nodiscard]] Vec3 middle(const Nodes& nodes) const {
    Vec3 sum = {0.0, 0.0, 0.0};
    for (const int n : nodes)
      for (std::size_t c = 0; c < 3; ++c) sum[c] += whole.nodes.position[n][c] / static_cast<double>(nodes.size());
    return sum;
  }

  // What a thing on this side counts for: the whole has `images` of it, the part's parts() times `here`.
  template <class OnThisSide>
  [[nodiscard]] double weight(int which, const std::vector<const std::vector<int>*>& by, OnThisSide here) const {
    const std::vector<int> images = orbit(which, by);
    const auto count = std::count_if(images.begin(), images.end(), here);
    return static_cast<double>(images.size()) / static_cast<double>(count << symmetry.plane.size());
  }

  int add_node(int n, double mass) {
    int& number = part_of_whole[n];
    if (number >= 0) return number;
    number = part.mesh.node_count();
    part.mesh.nodes.add(whole.nodes.position[n], mass, whole.nodes.crossing[n]);
    part.mesh.symmetry.whole_node.push_back(n);
    return number;
  }

  // The node of the part that is the image of `n` in the planes it lies beyond.
  [[nodiscard]] int on_this_side(int n, unsigned planes) const {
    for (std::size_t k = 0; k < symmetry.plane.size(); ++k)
      if ((planes >> k & 1U) != 0) n = symmetry.map[k].node[n];
    return part_of_whole[n];
  }

  // A node beyond a plane that an element here reaches to has no mass of its own.
  int node_of_element(int n) {
    if (part_of_whole[n] >= 0) return part_of_whole[n];
    const unsigned planes = beyond(whole.nodes.position[n]);
    const int of = on_this_side(n, planes);
    const int node = add_node(n, 0.0);
    part.mesh.symmetry.image.push_back({node, of, planes});
    return node;
  }

  void take_nodes() {
    const auto by = maps(&MirrorMap::node);
    const auto here = [&](int n) { return beyond(whole.nodes.position[n]) == 0; };
    for (int n = 0; n < whole.node_count(); ++n)
      if (here(n)) add_node(n, whole.nodes.mass[n] * weight(n, by, here));
    for (int n = 0; n < whole.node_count(); ++n) {
      const unsigned planes = beyond(whole.nodes.position[n]);
      part.image.push_back({on_this_side(n, planes), planes});
    }
    auto& on_plane = part.mesh.symmetry.on_plane;
    on_plane.resize(symmetry.plane.size());
    for (std::size_t k = 0; k < symmetry.plane.size(); ++k)
      for (int n = 0; n < part.mesh.node_count(); ++n)
        if (std::abs(height(part.mesh.nodes.position[n], k)) <= tolerance) on_plane[k].push_back(n);
  }

  void take_yarns(bool run_on) {
    const auto by = maps(&MirrorMap::yarn);
    const auto here = [&](int e) { return beyond(middle(whole.yarns.node[e])) == 0; };
    for (int e = 0; e < whole.yarn_count(); ++e) {
      const auto [a, b] = whole.yarns.node[e];
      const bool meets_plane = beyond(whole.nodes.position[a]) == 0 || beyond(whole.nodes.position[b]) == 0;
      if (!here(e) && !(run_on && meets_plane)) continue;
      const double share = here(e) ? weight(e, by, here) : 0.0;
      MeshYarn yarn = whole.yarns.at(e);
      yarn.node = {node_of_element(a), node_of_element(b)};
      yarn.section *= share;
      part.mesh.yarns.add(yarn);
    }
  }

  void take_cells() {
    const auto by = maps(&MirrorMap::cell);
    const auto& from = whole.cells;
    const auto nodes_of = [&](int c) {
      return std::vector<int>(from.node.begin() + from.offset[c], from.node.begin() + from.offset[c + 1]);
    };
    const auto here = [&](int c) { return beyond(middle(nodes_of(c))) == 0; };
    for (int c = 0; c < from.size(); ++c) {
      if (!here(c)) continue;
      std::vector<int> nodes = nodes_of(c);
      for (int& n : nodes) n = node_of_element(n);
      const std::vector<Vec2> coefficients(from.coefficient.begin() + from.offset[c],
                                           from.coefficient.begin() + from.offset[c + 1]);
      part.mesh.cells.add(nodes, coefficients, weight(c, by, here) * from.area[c], from.lattice[c]);
    }
  }

  void take_ties_and_sets() {
    for (const auto& tie : whole.tie) {
      if (beyond(whole.nodes.position[tie.node]) != 0) continue;
      part.mesh.tie.push_back(
          {part_of_whole[tie.node], {node_of_element(tie.to[0]), node_of_element(tie.to[1])}, tie.share});
    }
    for (const auto& set : whole.sets) {
      NodeSet own{set.name, {}};
      for (const int n : set.node)
        if (beyond(whole.nodes.position[n]) == 0) own.node.push_back(part_of_whole[n]);
      std::sort(own.node.begin(), own.node.end());
      part.mesh.sets.push_back(std::move(own));
    }
  }

  // Rows and columns of the lattice from zero on.
  void shift_lattice() {
    auto& mesh = part.mesh;
    std::array<int, 2> least = whole.lattice_size, most = {-1, -1};
    for (const auto& crossing : mesh.nodes.crossing)
      for (std::size_t f = 0; f < 2 && crossing[0] >= 0; ++f) {
        least[f] = std::min(least[f], crossing[f]);
        most[f] = std::max(most[f], crossing[f]);
      }
    for (auto& crossing : mesh.nodes.crossing)
      if (crossing[0] >= 0) crossing = {crossing[0] - least[0], crossing[1] - least[1]};
    for (auto& corner : mesh.cells.lattice) corner = {corner[0] - least[0], corner[1] - least[1]};
    mesh.lattice_size = {most[0] - least[0] + 1, most[1] - least[1] + 1};
  }
};

}  // namespace

SymmetricPart cut_part(const Mesh& whole, const Symmetry& symmetry, bool run_on) {
  Cutter cutter(whole, symmetry);
  cutter.part.mesh.symmetry.plane = symmetry.plane;
  for (const auto& map : symmetry.map) cutter.part.mesh.symmetry.set_image.push_back(map.set);
  cutter.part.mesh.spacing = whole.spacing;
  cutter.part.mesh.thickness = whole.thickness;
  cutter.part.mesh.first_shown = whole.first_shown;
  cutter.take_nodes();
  cutter.take_yarns(run_on);
  cutter.take_cells();
  cutter.take_ties_and_sets();
  cutter.shift_lattice();
  return std::move(cutter.part);
}

std::vector<Vec3> unfold(const SymmetricPart& part, const Mesh& whole, const std::vector<Vec3>& position) {
  std::vector<Vec3> result(whole.nodes.position);
  for (std::size_t n = 0; n < result.size(); ++n) {
    const auto [node, planes] = part.image[n];
    const Vec3 &x = position[node], &start = part.mesh.nodes.position[node];
    const Vec3 moved = mirrored_vector(minus(x, start), part.mesh.symmetry.plane, planes);
    for (std::size_t c = 0; c < 3; ++c) result[n][c] += moved[c];
  }
  return result;
}

}  // namespace weaveform
