#include "solver/contact/ply_arms.hpp"

#include <utility>

namespace weaveform {
namespace {

// a + s M b and b + s M a, M the mirroring.
std::array<Vec3, 2> with_images(const std::array<Vec3, 2>& of, const Vec3& normal, double swaps) {
  const SymmetryPlane plane{{0.0, 0.0, 0.0}, normal};
  return {plus(of[0], scaled(mirrored_vector(of[1], plane), swaps)),
          plus(of[1], scaled(mirrored_vector(of[0], plane), swaps))};
}

}  // namespace

std::vector<NodeArms> node_arms(const Mesh& mesh, const PackedMesh& packed) {
  std::vector<NodeArms> arms(packed.nodes);
  for (int n = 0; n < packed.nodes; ++n) arms[n].arm.fill(n);
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const int a = packed.packed_of_mesh[mesh.yarns.node[e][0]], b = packed.packed_of_mesh[mesh.yarns.node[e][1]];
    const std::size_t first = mesh.yarns.family[e] == Family::warp ? 0 : 2;
    arms[a].arm[first + 1] = b;
    arms[b].arm[first] = a;
  }
  // a yarn end lies between nothing across its yarn: it looks at its crossing's neighbours
  const auto given = arms;
  for (const int n : packed.packed_of_mesh)
    for (const std::size_t first : {std::size_t{0}, std::size_t{2}}) {
      if (given[n].arm[first] != n || given[n].arm[first + 1] != n) continue;
      for (const int beside : given[n].arm)
        if (beside != n && (given[beside].arm[first] != beside || given[beside].arm[first + 1] != beside)) {
          arms[n].arm[first] = given[beside].arm[first];
          arms[n].arm[first + 1] = given[beside].arm[first + 1];
          break;
        }
    }
  return arms;
}

std::vector<NodeArms> whole_arms(const Mesh& mesh, const PackedMesh& packed) {
  constexpr double least_length = 0.75;  // of a cell
  std::vector<NodeArms> arms(packed.nodes);
  for (int n = 0; n < packed.nodes; ++n) arms[n].arm.fill(n);
  const auto is_crossing = [&](int node) { return mesh.nodes.crossing[node][0] >= 0; };
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [first, second] = mesh.yarns.node[e];
    const std::size_t along = mesh.yarns.family[e] == Family::warp ? 0 : 1;
    if (!is_crossing(first) || !is_crossing(second) || mesh.yarns.rest_length[e] < least_length * mesh.spacing[along])
      continue;
    const int a = packed.packed_of_mesh[first], b = packed.packed_of_mesh[second];
    arms[a].arm[2 * along + 1] = b;
    arms[b].arm[2 * along] = a;
  }
  const auto given = arms;
  const auto has = [&](int node, std::size_t k) {
    return given[node].arm[k] != node || given[node].arm[k + 1] != node;
  };
  for (int e = 0; e < mesh.yarn_count(); ++e)
    for (const auto& [at, beside] : {std::pair{0, 1}, std::pair{1, 0}}) {
      const int node = packed.packed_of_mesh[mesh.yarns.node[e][at]],
                other = packed.packed_of_mesh[mesh.yarns.node[e][beside]];
      for (const std::size_t k : {0U, 2U}) {
        const bool lacks = arms[node].arm[k] == node && arms[node].arm[k + 1] == node;
        if (!lacks || !has(other, k)) continue;
        arms[node].arm[k] = given[other].arm[k];
        arms[node].arm[k + 1] = given[other].arm[k + 1];
      }
    }
  return arms;
}

PlyArms::PlyArms(const Mesh& mesh, const PackedMesh& packed, const Components& start, std::vector<NodeArms> arms)
    : arms_(std::move(arms)), flat_(packed.nodes) {
  find_planes(mesh, packed, start);
}

// Blanks that are mirrored start flat, their normal up.
void PlyArms::find_planes(const Mesh& mesh, const PackedMesh& packed, const Components& start) {
  constexpr double a_quarter = 0.25;  // of the square: yarns run along a plane, across it, or at 45 deg to it
  for (std::size_t k = 0; k < mesh.symmetry.plane.size(); ++k)
    for (const int n : mesh.symmetry.on_plane[k]) {
      const int node = packed.packed_of_mesh[n];
      const SymmetryPlane& plane = mesh.symmetry.plane[k];
      const auto [a, b] = between_arms(node, start);
      const bool warp = dot(a, a) > 0.0;
      const Vec3& arm = warp ? a : b;
      const double across = dot(arm, plane.normal), part = across * across / dot(arm, arm);
      double swaps = 0.0;
      if (part > a_quarter && part < 1.0 - a_quarter) {
        const Vec3 image = mirrored_vector(arm, plane);
        swaps = (warp ? cross(arm, image) : cross(image, arm))[2] > 0.0 ? 1.0 : -1.0;
      }
      flat_[node].push_back({plane.normal, swaps});
    }
}

// In a plane that swaps the families the arms beyond it are missing: they are images of the other family's.
std::array<Vec3, 2> PlyArms::between_arms(int node, const Components& x) const {
  const auto& arm = arms_[node].arm;
  std::array<Vec3, 2> between{};
  for (std::size_t c = 0; c < 3; ++c) {
    between[0][c] = x[c][arm[1]] - x[c][arm[0]];
    between[1][c] = x[c][arm[3]] - x[c][arm[2]];
  }
  return between;
}

// The image of what lies on one side of a plane lies on the other, and what is between them does not lean.
std::array<Vec3, 2> PlyArms::between(int node, const Components& position) const {
  std::array<Vec3, 2> arms = between_arms(node, position);
  for (const auto& [plane, swaps] : flat_[node]) {
    if (swaps != 0.0) {
      arms = with_images(arms, plane, swaps);
      continue;
    }
    // along the plane or across it, whichever the yarn is
    for (auto& one : arms) {
      const double across = dot(one, plane);
      const Vec3 flat = minus(one, scaled(plane, across));
      one = across * across > dot(flat, flat) ? scaled(plane, across) : flat;
    }
  }
  return arms;
}

// The vectors as they are made of the arms' are their own transpose, and so the levers.
void PlyArms::add_levers(int node, std::array<Vec3, 2> lever, Components& force) const {
  for (auto plane = flat_[node].rbegin(); plane != flat_[node].rend(); ++plane)
    if (plane->swaps != 0.0) lever = with_images(lever, plane->normal, plane->swaps);
  const auto& arm = arms_[node].arm;
  for (std::size_t c = 0; c < 3; ++c) {
    force[c][arm[1]] += lever[0][c];
    force[c][arm[0]] -= lever[0][c];
    force[c][arm[3]] += lever[1][c];
    force[c][arm[2]] -= lever[1][c];
  }
}

}  // namespace weaveform
