#include "solver/constraint/grips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "mesher/scene/grip_direction.hpp"

namespace weaveform {
namespace {

double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec3 turned(const Vec3& a, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * a[0] - s * a[1], s * a[0] + c * a[1], a[2]};
}

}  // namespace

double smooth_step(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

std::vector<Grip> make_grips(const Scene& scene, const Mesh& mesh, const PackedMesh& packed) {
  if (scene.frame) {
    if (!mesh.frame.present())
      throw InputError("frame: the mesh has no shear frame; make the mesh again from this scene");
    return make_frame_grips(*scene.frame, mesh, packed);
  }
  std::vector<Grip> grips;
  for (const auto& spec : scene.grip) {
    const auto set =
        std::find_if(mesh.sets.begin(), mesh.sets.end(), [&](const NodeSet& s) { return s.name == spec.name; });
    if (set == mesh.sets.end())
      throw InputError("grip '" + spec.name +
                       "': the mesh has no node set of that name; make the mesh again from this scene");
    Grip grip;
    grip.name = spec.name;
    grip.travel = spec.travel;
    grip.direction = turned(grip_direction(spec), scene.blank.orientation);
    for (int c = 0; c < 3; ++c) {
      if (std::find(spec.free.begin(), spec.free.end(), Component{c}) != spec.free.end()) continue;
      Vec3 axis = {0.0, 0.0, 0.0};
      axis[c] = 1.0;
      grip.held.push_back(turned(axis, scene.blank.orientation));
    }
    for (const int n : set->node) {
      grip.node.push_back(packed.packed_of_mesh[n]);
      grip.start.push_back(mesh.nodes.position[n]);
    }
    grip.velocity_before.resize(grip.node.size());
    grips.push_back(std::move(grip));
  }
  return grips;
}

std::vector<char> held_nodes(const std::vector<Grip>& grips, const Mesh& mesh, const PackedMesh& packed) {
  std::vector<char> packed_held(packed.nodes, 0), held(mesh.node_count(), 0);
  for (const auto& grip : grips)
    if (grip.holds_all())
      for (const int n : grip.node) packed_held[n] = 1;
  for (int n = 0; n < mesh.node_count(); ++n) held[n] = packed_held[packed.packed_of_mesh[n]];
  for (const auto& image : mesh.symmetry.image) held[image.node] = held[image.of];
  return held;
}

void remember_velocities(Grip& grip, const State& state) {
  for (std::size_t k = 0; k < grip.node.size(); ++k)
    for (int c = 0; c < 3; ++c) grip.velocity_before[k][c] = state.velocity[c][grip.node[k]];
}

double apply_grip(const Grip& grip, const PackedMesh& packed, State& state, double from, double to, double kick,
                  double drift, double& sum_change) {
  double along_motion = 0.0;
  using Corners = std::array<FrameMechanism::Place, 4>;
  const Corners corners = grip.mechanism ? grip.mechanism->corners(to) : Corners{};
  const Corners before = grip.mechanism ? grip.mechanism->corners(from) : Corners{};
  for (std::size_t k = 0; k < grip.node.size(); ++k) {
    const int n = grip.node[k];
    const double mass = packed.mass[n];
    Vec3 velocity, position;
    for (int c = 0; c < 3; ++c) {
      velocity[c] = state.velocity[c][n];
      position[c] = state.position[c][n];
    }
    const Vec3 free_velocity = velocity;
    Vec3 slope = grip.direction;
    if (grip.mechanism) {
      const auto end = FrameMechanism::on_member(corners, grip.mechanism->point[k]);
      const auto start = FrameMechanism::on_member(before, grip.mechanism->point[k]);
      // the force belongs to the start of the step
      slope = start.slope;
      for (int c = 0; c < 3; ++c) velocity[c] = (end.position[c] - start.position[c]) / drift;
      position = end.position;
    } else {
      for (const auto& axis : grip.held) {
        const double along = dot(grip.direction, axis);
        const double velocity_off = (to - from) * along / drift - dot(velocity, axis);
        const double position_off = dot(grip.start[k], axis) + to * along - dot(position, axis);
        for (int c = 0; c < 3; ++c) {
          velocity[c] += velocity_off * axis[c];
          position[c] += position_off * axis[c];
        }
      }
    }
    for (int c = 0; c < 3; ++c) {
      along_motion += mass * (velocity[c] - free_velocity[c]) / kick * slope[c];
      const double velocity_before = grip.velocity_before[k][c];
      const double middle_free = 0.5 * (velocity_before + free_velocity[c]);
      const double middle = 0.5 * (velocity_before + velocity[c]);
      sum_change += mass * (middle * middle - middle_free * middle_free);
      state.velocity[c][n] = velocity[c];
      state.position[c][n] = position[c];
    }
  }
  return along_motion;
}

}  // namespace weaveform
