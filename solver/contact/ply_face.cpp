#include "solver/contact/ply_face.hpp"

#include <algorithm>
#include <utility>

#include "solver/contact/node_area.hpp"

namespace weaveform {
namespace {

// a + s M b and b + s M a, M the mirroring.
std::array<Vec3, 2> with_images(const std::array<Vec3, 2>& of, const Vec3& normal, double swaps) {
  const SymmetryPlane plane{{0.0, 0.0, 0.0}, normal};
  return {plus(of[0], scaled(mirrored_vector(of[1], plane), swaps)),
          plus(of[1], scaled(mirrored_vector(of[0], plane), swaps))};
}

}  // namespace

PlyFace::PlyFace(Ply& ply, std::string name)
    : ply_(ply),
      name_(std::move(name)),
      surface_(ply.mesh(), ply.packed()),
      arms_(node_arms(ply.mesh(), ply.packed())),
      flat_(ply.packed().nodes),
      mesh_of_packed_(ply.packed().nodes, -1) {
  const Mesh& mesh = ply.mesh();
  for (int n = 0; n < mesh.node_count(); ++n) mesh_of_packed_[ply.packed().packed_of_mesh[n]] = mesh.shown_node(n);
  find_planes();
  make_blocks();
  find_irregular();
  double mass = 0.0, area = 0.0;
  for (int l = 0; l < lanes(); ++l) {
    mass += mass_[l];
    area += area_[l];
  }
  touching_.thickness = mesh.thickness;
  touching_.density = area > 0.0 ? mass / area : 0.0;
  touching_.spacing = std::min(mesh.spacing[0], mesh.spacing[1]);
  touching_.node_mass = touching_.density * mesh.spacing[0] * mesh.spacing[1];
}

// Blanks that are mirrored start flat, their normal up.
void PlyFace::find_planes() {
  constexpr double a_quarter = 0.25;  // of the square: yarns run along a plane, across it, or at 45 deg to it
  const Mesh& mesh = ply_.mesh();
  for (std::size_t k = 0; k < mesh.symmetry.plane.size(); ++k)
    for (const int n : mesh.symmetry.on_plane[k]) {
      const int packed = ply_.packed().packed_of_mesh[n];
      const SymmetryPlane& plane = mesh.symmetry.plane[k];
      const auto [a, b] = between_arms(packed);
      const bool warp = dot(a, a) > 0.0;
      const Vec3& arm = warp ? a : b;
      const double across = dot(arm, plane.normal), part = across * across / dot(arm, arm);
      double swaps = 0.0;
      if (part > a_quarter && part < 1.0 - a_quarter) {
        const Vec3 image = mirrored_vector(arm, plane);
        swaps = (warp ? cross(arm, image) : cross(image, arm))[2] > 0.0 ? 1.0 : -1.0;
      }
      flat_[packed].push_back({plane.normal, swaps});
    }
}

void PlyFace::make_blocks() {
  const PackedMesh& packed = ply_.packed();
  const Doubles area = node_areas(ply_.mesh(), packed);
  lane_of_.assign(packed.nodes, -1);
  const auto touches = [&](int n) { return mesh_of_packed_[n] >= 0 && packed.mass[n] > 0.0; };
  const auto same_row = [&](int a, int b) {
    return a >= packed.lattice_nodes() || b >= packed.lattice_nodes() ? a >= packed.lattice_nodes()
                                                                      : a / packed.stride == b / packed.stride;
  };
  for (int n = 0; n < packed.nodes;) {
    if (!touches(n)) {
      ++n;
      continue;
    }
    PlyBlock block = {.first = n, .count = 0, .at = lanes(), .lanes = 0};
    while (n < packed.nodes && touches(n) && same_row(block.first, n) && block.count < ply_nodes_at_a_time) {
      lane_of_[n] = block.at + block.count;
      node_of_.push_back(n);
      mass_.push_back(packed.mass[n]);
      area_.push_back(area[n]);
      ++block.count;
      ++n;
    }
    block.lanes = (block.count + ply_nodes_padded_to - 1) / ply_nodes_padded_to * ply_nodes_padded_to;
    node_of_.resize(block.at + block.lanes, -1);
    mass_.resize(block.at + block.lanes, 0.0);
    area_.resize(block.at + block.lanes, 0.0);
    blocks_.push_back(block);
  }
}

// Nodes of a block that is not far enough from the ends of the arrays are all left to the list.
void PlyFace::find_irregular() {
  const int stride = ply_.packed().stride;
  for (const auto& block : blocks_) {
    first_irregular_.push_back(static_cast<int>(irregular_.size()));
    const bool at_the_end = block.first < stride || block.first + block.lanes + stride > nodes();
    for (int n = block.first; n < block.first + block.count; ++n)
      if (const std::array<int, 4> regular = {n - 1, n + 1, n - stride, n + stride};
          at_the_end || arms_[n].arm != regular || !flat_[n].empty())
        irregular_.push_back(n);
  }
  first_irregular_.push_back(static_cast<int>(irregular_.size()));
  irregular_lever_.assign(irregular_.size(), {});
  has_levers_.assign(blocks_.size(), 0);
  for (auto& component : lever_) component.assign(static_cast<std::size_t>(nodes()) + 2 * stride, 0.0);
}

Vec3 PlyFace::position(int node) const {
  const auto& x = state().position;
  return {x[0][node], x[1][node], x[2][node]};
}

// In a plane that swaps the families the arms beyond it are missing: they are images of the other family's.
std::array<Vec3, 2> PlyFace::between_arms(int node) const {
  const auto& arm = arms_[node].arm;
  return {minus(position(arm[1]), position(arm[0])), minus(position(arm[3]), position(arm[2]))};
}

// The image of what lies on one side of a plane lies on the other, and what is between them does not lean.
std::array<Vec3, 2> PlyFace::between_neighbours(int node) const {
  std::array<Vec3, 2> arms = between_arms(node);
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

Vec3 PlyFace::normal(int node) const {
  const auto [a, b] = between_neighbours(node);
  return cross(a, b);
}

void PlyFace::frame(int number, BlockFrame& frame) const {
  const PlyBlock& block = blocks_[number];
  const int first = block.first, stride = ply_.packed().stride;
  const auto& x = state().position;
  for (int c = 0; c < 3; ++c) frame.x[c] = x[c].data() + first;
  if (first + block.lanes > nodes())
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < block.lanes; ++i) frame.copy[c][i] = frame.x[c][std::min(i, block.count - 1)];
      frame.x[c] = frame.copy[c];
    }
  const bool regular = first >= stride && first + block.lanes + stride <= nodes();
  for (int c = 0; c < 3; ++c) {
    const double* const at = x[c].data() + first;
    if (regular) {
      loops_of_plies().way(block.count, at - 1, at + 1, frame.a[c]);
      loops_of_plies().way(block.count, at - stride, at + stride, frame.b[c]);
    }
    for (int i = block.count; i < block.lanes; ++i) frame.a[c][i] = frame.b[c][i] = 0.0;
  }
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k) {
    const auto [a, b] = between_neighbours(irregular_[k]);
    for (int c = 0; c < 3; ++c) {
      frame.a[c][irregular_[k] - first] = a[c];
      frame.b[c][irregular_[k] - first] = b[c];
    }
  }
}

void PlyFace::clear_levers(int number) {
  if (has_levers_[number] == 0) return;
  has_levers_[number] = 0;
  const PlyBlock& block = blocks_[number];
  const int stride = ply_.packed().stride;
  for (auto& component : lever_) std::fill_n(component.begin() + stride + block.first, block.count, 0.0);
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k) irregular_lever_[k].fill(0.0);
}

void PlyFace::add_levers(int number, int first, int end, const double (&lever)[6][ply_nodes_at_a_time]) {
  has_levers_[number] = 1;
  const int stride = ply_.packed().stride;
  for (std::size_t c = 0; c < 6; ++c)
    loops_of_plies().add(end - first, lever[c] + first, lever_[c].data() + stride + blocks_[number].first + first);
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k)
    for (std::size_t c = 0; c < 6; ++c) {
      double& there = lever_[c][stride + irregular_[k]];
      irregular_lever_[k][c] += there;
      there = 0.0;
    }
}

bool PlyFace::has_levers() const {
  return std::find(has_levers_.begin(), has_levers_.end(), char{1}) != has_levers_.end();
}

void PlyFace::take_levers(int first, int end) {
  const int stride = ply_.packed().stride;
  for (std::size_t c = 0; c < 3; ++c)
    loops_of_plies().lever(end - first, stride, lever_[c].data() + stride + first,
                           lever_[c + 3].data() + stride + first, state().force[c].data() + first);
}

void PlyFace::take_irregular_levers() {
  auto& force = state().force;
  for (std::size_t k = 0; k < irregular_.size(); ++k) {
    const auto& arm = arms_[irregular_[k]].arm;
    const auto& sum = irregular_lever_[k];
    // the vectors as they are made of the arms' are their own transpose, and so the levers
    std::array<Vec3, 2> lever = {Vec3{sum[0], sum[1], sum[2]}, Vec3{sum[3], sum[4], sum[5]}};
    const auto& planes = flat_[irregular_[k]];
    for (auto plane = planes.rbegin(); plane != planes.rend(); ++plane)
      if (plane->swaps != 0.0) lever = with_images(lever, plane->normal, plane->swaps);
    for (std::size_t c = 0; c < 3; ++c) {
      force[c][arm[1]] += lever[0][c];
      force[c][arm[0]] -= lever[0][c];
      force[c][arm[3]] += lever[1][c];
      force[c][arm[2]] -= lever[1][c];
    }
  }
}

double PlyFace::speed(int block) const {
  const auto& v = state().velocity;
  const int first = blocks_[block].first;
  const double* const at[3] = {v[0].data() + first, v[1].data() + first, v[2].data() + first};
  return loops_of_plies().speed(blocks_[block].count, at);
}

}  // namespace weaveform
