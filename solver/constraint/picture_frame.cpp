#include "solver/constraint/picture_frame.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "solver/constraint/grips.hpp"

namespace weaveform {
namespace {

Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Vec3 unit(const Vec3& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

const std::vector<Vec3> all_axes = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

FrameMechanism mechanism_of(const FrameSpec& frame, const Mesh& mesh) {
  const auto& corner = mesh.frame.corner;
  FrameMechanism mechanism;
  mechanism.length = frame.length;
  mechanism.base = mesh.nodes.position[corner[0]];
  mechanism.along = unit(difference(mesh.nodes.position[corner[2]], mechanism.base));
  mechanism.across = unit(difference(mesh.nodes.position[corner[1]], mesh.nodes.position[corner[3]]));
  return mechanism;
}

}  // namespace

std::array<FrameMechanism::Place, 4> FrameMechanism::corners(double travel) const {
  const double half = 0.5 * (std::numbers::sqrt2 * length + travel);
  const double width = std::sqrt(std::max(0.0, length * length - half * half));
  const double width_slope = width > 0.0 ? -0.5 * half / width : 0.0;  // dw/d(travel), dh/d(travel) = 1/2
  std::array<Place, 4> result{};
  for (int c = 0; c < 3; ++c) {
    result[0].position[c] = base[c];
    result[1].position[c] = base[c] + half * along[c] + width * across[c];
    result[2].position[c] = base[c] + 2.0 * half * along[c];
    result[3].position[c] = base[c] + half * along[c] - width * across[c];
    result[1].slope[c] = 0.5 * along[c] + width_slope * across[c];
    result[2].slope[c] = along[c];
    result[3].slope[c] = 0.5 * along[c] - width_slope * across[c];
  }
  return result;
}

FrameMechanism::Place FrameMechanism::on_member(const std::array<Place, 4>& corners, const Point& point) {
  const auto &a = corners[point.corner[0]], &b = corners[point.corner[1]];
  Place place{};
  for (int c = 0; c < 3; ++c) {
    place.position[c] = a.position[c] + point.share * (b.position[c] - a.position[c]);
    place.slope[c] = a.slope[c] + point.share * (b.slope[c] - a.slope[c]);
  }
  return place;
}

std::vector<Grip> make_frame_grips(const FrameSpec& frame, const Mesh& mesh, const PackedMesh& packed) {
  const auto& corner = mesh.frame.corner;
  const FrameMechanism mechanism = mechanism_of(frame, mesh);
  const auto grip_at = [&](const std::string& name, const std::vector<int>& nodes, const Vec3& direction,
                           double travel) {
    Grip grip;
    grip.name = name;
    grip.direction = direction;
    grip.travel = travel;
    grip.held = all_axes;
    for (const int n : nodes) {
      grip.node.push_back(packed.packed_of_mesh[n]);
      grip.start.push_back(mesh.nodes.position[n]);
    }
    grip.velocity_before.resize(nodes.size());
    return grip;
  };
  if (!frame.rigid) {
    Vec3 back = mechanism.along;
    for (auto& component : back) component = -component;
    return {grip_at("base", {corner[0]}, back, 0.0), grip_at(frame.grip, {corner[2]}, mechanism.along, frame.travel)};
  }
  std::map<int, int> corner_number;
  std::vector<int> nodes(corner.begin(), corner.end());
  for (int k = 0; k < 4; ++k) corner_number[corner[k]] = k;
  for (const auto& tie : mesh.tie) nodes.push_back(tie.node);
  Grip grip = grip_at(frame.grip, nodes, mechanism.along, frame.travel);
  grip.mechanism = mechanism;
  for (int k = 0; k < 4; ++k) grip.mechanism->point.push_back({{k, k}, 0.0});
  for (const auto& tie : mesh.tie)
    grip.mechanism->point.push_back({{corner_number[tie.to[0]], corner_number[tie.to[1]]}, tie.share});
  return {grip};
}

FrameMembers::FrameMembers(const FrameSpec& frame, const Mesh& mesh, const PackedMesh& packed)
    : mesh_corner_(mesh.frame.corner), stiffness_(frame.modulus * frame.section), length_(frame.length) {
  for (int k = 0; k < 4; ++k) corner_[k] = packed.packed_of_mesh[mesh_corner_[k]];
}

void FrameMembers::add_forces(State& state, double /*step*/) {
  energy_ = 0.0;
  for (int k = 0; k < 4; ++k) {
    const int a = corner_[k], b = corner_[(k + 1) % 4];
    Vec3 along;
    for (int c = 0; c < 3; ++c) along[c] = state.position[c][b] - state.position[c][a];
    const double length = std::hypot(along[0], along[1], along[2]);
    const double strain = std::log(length / length_);
    const double per_length = stiffness_ * strain * length_ / (length * length);  // N/L
    energy_ += 0.5 * stiffness_ * length_ * strain * strain;
    for (int c = 0; c < 3; ++c) {
      state.force[c][a] += per_length * along[c];
      state.force[c][b] -= per_length * along[c];
    }
  }
}

void FrameMembers::add_stiffness_bound(const std::vector<Vec3>& /*position*/, double /*fabric_frequency*/,
                                       std::vector<double>& bound) const {
  for (const int n : mesh_corner_) bound[n] += 2.0 * 2.0 * stiffness_ / length_;  // two members, 2 EA/L each
}

}  // namespace weaveform
