#include "solver/contact/ply_face.hpp"

#include <algorithm>
#include <utility>

#include "solver/contact/node_area.hpp"

namespace weaveform {

PlyFace::PlyFace(Ply& ply, std::string name, ShearedThickness* sheared)
    : ply_(ply),
      name_(std::move(name)),
      sheared_(sheared),
      surface_(ply.mesh(), ply.packed()),
      edges_(ply, surface_),
      arms_(ply.mesh(), ply.packed(), ply.state().position, node_arms(ply.mesh(), ply.packed())),
      mesh_of_packed_(ply.packed().nodes, -1) {
  const Mesh& mesh = ply.mesh();
  for (int n = 0; n < mesh.node_count(); ++n) mesh_of_packed_[ply.packed().packed_of_mesh[n]] = mesh.shown_node(n);
  make_blocks();
  find_irregular();
  double mass = 0.0, area = 0.0;
  for (int l = 0; l < lanes(); ++l) {
    if (!(area_[l] > 0.0)) continue;  // arms and corners of a frame are no fabric
    mass += mass_[l];
    area += area_[l];
  }
  touching_.thickness = mesh.thickness;
  touching_.density = area > 0.0 ? mass / area : 0.0;
  touching_.spacing = std::min(mesh.spacing[0], mesh.spacing[1]);
  touching_.node_mass = touching_.density * mesh.spacing[0] * mesh.spacing[1];
}

void PlyFace::make_swell() {
  if (thickens()) return;
  even_swell_.assign(static_cast<std::size_t>(nodes()) + ply_nodes_at_a_time, 1.0);
  even_load_.assign(even_swell_.size(), 0.0);
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

void PlyFace::set_chunks(std::vector<int> first_blocks) {
  chunk_at_ = std::move(first_blocks);
  for (int& first : chunk_at_) first = blocks_[first].at;
}

std::array<int, 4> PlyFace::lanes_beside(int lane) const {
  const auto chunk_of = [&](int l) { return std::upper_bound(chunk_at_.begin(), chunk_at_.end(), l); };
  std::array<int, 4> beside = arms_.of(node_of_[lane]).arm;
  for (int& one : beside) {
    one = lane_of_[one];
    if (one == lane || (one >= 0 && chunk_of(one) != chunk_of(lane))) one = -1;
  }
  return beside;
}

// Nodes of a block that is not far enough from the ends of the arrays are all left to the list.
void PlyFace::find_irregular() {
  const int stride = ply_.packed().stride;
  for (const auto& block : blocks_) {
    first_irregular_.push_back(static_cast<int>(irregular_.size()));
    const bool at_the_end = block.first < stride || block.first + block.lanes + stride > nodes();
    for (int n = block.first; n < block.first + block.count; ++n)
      if (const std::array<int, 4> regular = {n - 1, n + 1, n - stride, n + stride};
          at_the_end || arms_.of(n).arm != regular || arms_.in_a_plane(n))
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

std::array<Vec3, 2> PlyFace::between_neighbours(int node) const {
  return arms_.between(node, state().position);
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
  PlyNormals& normals = frame.normals;
  const double* const at[3] = {x[0].data() + first, x[1].data() + first, x[2].data() + first};
  if (regular)
    loops_of_plies().ways(block.lanes, stride, at, normals);
  else
    for (int c = 0; c < 3; ++c)
      for (int i = block.count; i < block.lanes; ++i) normals.a[c][i] = normals.b[c][i] = 0.0;
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k) {
    const auto [a, b] = between_neighbours(irregular_[k]);
    for (int c = 0; c < 3; ++c) {
      normals.a[c][irregular_[k] - first] = a[c];
      normals.b[c][irregular_[k] - first] = b[c];
    }
  }
  loops_of_plies().turn(block.lanes, normals);
}

void PlyFace::take_nothing(int number) {
  if (has_levers_[number] == 0) return;
  const PlyBlock& block = blocks_[number];
  const int stride = ply_.packed().stride;
  for (auto& component : lever_) std::fill_n(component.begin() + stride + block.first, block.count, 0.0);
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k) irregular_lever_[k].fill(0.0);
  has_levers_[number] = 0;
}

void PlyFace::take(int number, const BlockFrame& frame, const PlyPull& pull) {
  const PlyBlock& block = blocks_[number];
  const int stride = ply_.packed().stride;
  auto& f = state().force;
  double* const force[3] = {f[0].data() + block.first, f[1].data() + block.first, f[2].data() + block.first};
  double* lever[6];
  for (std::size_t c = 0; c < 6; ++c) lever[c] = lever_[c].data() + stride + block.first;
  loops_of_plies().take(block.count, frame.normals, pull, force, lever);
  has_levers_[number] = 1;
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k)
    for (std::size_t c = 0; c < 6; ++c) {
      double& there = lever_[c][stride + irregular_[k]];
      irregular_lever_[k][c] = there;
      there = 0.0;
    }
}

bool PlyFace::has_levers() const {
  return std::find(has_levers_.begin(), has_levers_.end(), char{1}) != has_levers_.end();
}

void PlyFace::take_levers(int first, int end) {
  const int stride = ply_.packed().stride;
  const double* lever[6];
  for (std::size_t c = 0; c < 6; ++c) lever[c] = lever_[c].data() + stride + first;
  auto& f = state().force;
  loops_of_plies().lever(end - first, stride, lever, {f[0].data() + first, f[1].data() + first, f[2].data() + first});
}

void PlyFace::take_irregular_levers() {
  for (std::size_t k = 0; k < irregular_.size(); ++k) {
    const auto& sum = irregular_lever_[k];
    arms_.add_levers(irregular_[k], {Vec3{sum[0], sum[1], sum[2]}, Vec3{sum[3], sum[4], sum[5]}}, state().force);
  }
}

double PlyFace::speed(int block) const {
  const auto& v = state().velocity;
  const int first = blocks_[block].first;
  const double* const at[3] = {v[0].data() + first, v[1].data() + first, v[2].data() + first};
  return loops_of_plies().speed(blocks_[block].count, at);
}

}  // namespace weaveform
