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
      mass_(ply.packed().nodes, 0.0),
      area_(node_areas(ply.mesh(), ply.packed())),
      mesh_of_packed_(ply.packed().nodes, -1) {
  const Mesh& mesh = ply.mesh();
  const PackedMesh& packed = ply.packed();
  double mass = 0.0, area = 0.0;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const int p = packed.packed_of_mesh[n];
    mass_[p] = packed.mass[p];
    mesh_of_packed_[p] = mesh.shown_node(n);
    mass += mass_[p];
    area += area_[p];
  }
  for (std::size_t k = 0; k < mesh.symmetry.plane.size(); ++k)
    for (const int n : mesh.symmetry.on_plane[k])
      flat_[packed.packed_of_mesh[n]].push_back(mesh.symmetry.plane[k].normal);
  touching_.thickness = mesh.thickness;
  touching_.density = area > 0.0 ? mass / area : 0.0;
  touching_.spacing = std::min(mesh.spacing[0], mesh.spacing[1]);
  touching_.node_mass = touching_.density * mesh.spacing[0] * mesh.spacing[1];
  // the loop over whole blocks may read a row before and behind: the first and last blocks are left to the list
  for (int b = 0; b < blocks(); ++b) {
    first_irregular_.push_back(static_cast<int>(irregular_.size()));
    const int first = b * ply_nodes_at_a_time, end = first + block_size(b);
    const bool at_the_end = first < packed.stride || end + packed.stride > nodes();
    for (int n = first; n < end; ++n) {
      const std::array<int, 4> regular = {n - 1, n + 1, n - packed.stride, n + packed.stride};
      if (at_the_end || arms_[n].arm != regular || !flat_[n].empty()) irregular_.push_back(n);
    }
  }
  first_irregular_.push_back(static_cast<int>(irregular_.size()));
}

int PlyFace::block_size(int block) const {
  return std::min(ply_nodes_at_a_time, nodes() - block * ply_nodes_at_a_time);
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

void PlyFace::normals(int block, BlockNormals& normals) const {
  const int first = block * ply_nodes_at_a_time, count = block_size(block), stride = ply_.packed().stride;
  if (first >= stride && first + count + stride <= nodes()) {
    const auto& x = state().position;
    const double* const west[3] = {x[0].data() + first - 1, x[1].data() + first - 1, x[2].data() + first - 1};
    const double* const east[3] = {west[0] + 2, west[1] + 2, west[2] + 2};
    const double* const south[3] = {west[0] + 1 - stride, west[1] + 1 - stride, west[2] + 1 - stride};
    const double* const north[3] = {west[0] + 1 + stride, west[1] + 1 + stride, west[2] + 1 + stride};
    double* const n[3] = {normals.n[0], normals.n[1], normals.n[2]};
    loops_of_plies().normals(count, west, east, south, north, n);
  }
  for (int k = first_irregular_[block]; k < first_irregular_[block + 1]; ++k) {
    const Vec3 n = normal(irregular_[k]);
    for (int c = 0; c < 3; ++c) normals.n[c][irregular_[k] - first] = n[c];
  }
}

double PlyFace::speed(int block) const {
  const int first = block * ply_nodes_at_a_time;
  const auto& v = state().velocity;
  const double* const at[3] = {v[0].data() + first, v[1].data() + first, v[2].data() + first};
  return loops_of_plies().speed(block_size(block), mass_.data() + first, at);
}

}  // namespace weaveform
