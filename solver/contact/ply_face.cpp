#include "solver/contact/ply_face.hpp"

#include <algorithm>
#include <utility>

#include "solver/contact/node_area.hpp"

namespace weaveform {

PlyFace::PlyFace(Ply& ply, std::string name)
    : ply_(ply),
      name_(std::move(name)),
      surface_(ply.mesh(), ply.packed()),
      arms_(node_arms(ply.mesh(), ply.packed())),
      flat_(ply.packed().nodes),
      mesh_of_packed_(ply.packed().nodes, -1) {
  const Mesh& mesh = ply.mesh();
  for (int n = 0; n < mesh.node_count(); ++n) mesh_of_packed_[ply.packed().packed_of_mesh[n]] = mesh.shown_node(n);
  for (std::size_t k = 0; k < mesh.symmetry.plane.size(); ++k)
    for (const int n : mesh.symmetry.on_plane[k])
      flat_[ply.packed().packed_of_mesh[n]].push_back(mesh.symmetry.plane[k].normal);
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
}

Vec3 PlyFace::position(int node) const {
  const auto& x = state().position;
  return {x[0][node], x[1][node], x[2][node]};
}

// In a mirror plane lie the normals of its nodes, too.
Vec3 PlyFace::normal(int node) const {
  const auto& arm = arms_[node].arm;
  Vec3 n = cross(minus(position(arm[1]), position(arm[0])), minus(position(arm[3]), position(arm[2])));
  for (const auto& plane : flat_[node]) n = minus(n, scaled(plane, dot(n, plane)));
  return n;
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
  if (first >= stride && first + block.lanes + stride <= nodes()) {
    const double* const west[3] = {x[0].data() + first - 1, x[1].data() + first - 1, x[2].data() + first - 1};
    const double* const east[3] = {west[0] + 2, west[1] + 2, west[2] + 2};
    const double* const south[3] = {west[0] + 1 - stride, west[1] + 1 - stride, west[2] + 1 - stride};
    const double* const north[3] = {west[0] + 1 + stride, west[1] + 1 + stride, west[2] + 1 + stride};
    double* const n[3] = {frame.normal[0], frame.normal[1], frame.normal[2]};
    loops_of_plies().normals(block.count, west, east, south, north, n);
  }
  for (int k = first_irregular_[number]; k < first_irregular_[number + 1]; ++k) {
    const Vec3 n = normal(irregular_[k]);
    for (int c = 0; c < 3; ++c) frame.normal[c][irregular_[k] - first] = n[c];
  }
  for (int c = 0; c < 3; ++c)
    for (int i = block.count; i < block.lanes; ++i) frame.normal[c][i] = 0.0;
}

double PlyFace::speed(int block) const {
  const auto& v = state().velocity;
  const int first = blocks_[block].first;
  const double* const at[3] = {v[0].data() + first, v[1].data() + first, v[2].data() + first};
  return loops_of_plies().speed(blocks_[block].count, at);
}

}  // namespace weaveform
