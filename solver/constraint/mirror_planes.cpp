#include "solver/constraint/mirror_planes.hpp"

#include "core/vector/vector.hpp"

namespace weaveform {

MirrorPlanes::MirrorPlanes(const Mesh& mesh, PackedMesh& packed)
    : plane_(mesh.symmetry.plane), on_plane_(mesh.symmetry.on_plane) {
  for (unsigned planes = 0; planes < 1U << plane_.size(); ++planes) reflection_.push_back(reflection(plane_, planes));
  for (auto& nodes : on_plane_)
    for (int& n : nodes) n = packed.packed_of_mesh[n];
  for (const auto& image : mesh.symmetry.image) {
    const int node = packed.packed_of_mesh[image.node], of = packed.packed_of_mesh[image.of];
    packed.mass[of] += packed.mass[node];
    packed.mass[node] = 0.0;
    image_.push_back({node, of, image.planes, mesh.nodes.position[image.node], mesh.nodes.position[image.of]});
  }
}

void MirrorPlanes::give_forces(State& state) const {
  auto& force = state.force;
  for (const auto& image : image_) {
    const int n = image.node;
    const auto back = times(reflection_[image.planes], {force[0][n], force[1][n], force[2][n]});
    for (int c = 0; c < 3; ++c) {
      force[c][image.of] += back[c];
      force[c][n] = 0.0;
    }
  }
}

void MirrorPlanes::hold(State& state) const {
  auto& force = state.force;
  for (std::size_t k = 0; k < plane_.size(); ++k) {
    const auto& normal = plane_[k].normal;
    for (const int n : on_plane_[k]) {
      const double across = force[0][n] * normal[0] + force[1][n] * normal[1] + force[2][n] * normal[2];
      for (int c = 0; c < 3; ++c) force[c][n] -= across * normal[c];
    }
  }
}

void MirrorPlanes::follow(State& state) const {
  auto &x = state.position, &v = state.velocity;
  for (const auto& image : image_) {
    const int of = image.of;
    const Reflection& reflection = reflection_[image.planes];
    const auto moved =
        times(reflection, {x[0][of] - image.start_of[0], x[1][of] - image.start_of[1], x[2][of] - image.start_of[2]});
    const auto velocity = times(reflection, {v[0][of], v[1][of], v[2][of]});
    for (int c = 0; c < 3; ++c) {
      x[c][image.node] = image.start[c] + moved[c];
      v[c][image.node] = velocity[c];
    }
  }
}

}  // namespace weaveform
