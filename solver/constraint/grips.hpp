// Grips: named node sets whose motion is prescribed (smooth step along a direction) in all or some components, and the
// reaction forces that this takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/constraint/picture_frame.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// Smooth step 10 x^3 - 15 x^4 + 6 x^5 on [0, 1]: rest, no jump of speed or acceleration at either end; greatest slope
// 15/8.
[[nodiscard]] double smooth_step(double x);
inline constexpr double smooth_step_greatest_slope = 1.875;

struct Grip {
  std::string name;
  std::vector<int> node;                    // packed
  std::vector<Vec3> start;                  // mm; initial position of each node
  Vec3 direction = {0, 1, 0};               // world; unit
  std::vector<Vec3> held;                   // world; unit vectors of the prescribed components
  double travel = 0.0;                      // mm
  std::optional<FrameMechanism> mechanism;  // nodes follow a rigid shear frame instead of moving along `direction`
  std::vector<Vec3> velocity_before;        // mm/s; of each node before the step at hand
  [[nodiscard]] bool holds_all() const { return held.size() == 3; }
};

// Grips of the scene on the mesh's node sets; directions turned into the world by the blank's orientation. Throws
// InputError when a grip's set is missing from the mesh.
[[nodiscard]] std::vector<Grip> make_grips(const Scene& scene, const Mesh& mesh, const PackedMesh& packed);

// Mesh nodes whose every component some grip prescribes.
[[nodiscard]] std::vector<char> held_nodes(const std::vector<Grip>& grips, const Mesh& mesh, const PackedMesh& packed);

void remember_velocities(Grip& grip, const State& state);

// Puts a grip's nodes where they belong at the end of a step, all nodes having been advanced freely. `from` and `to`
// are the grip's displacement at both ends of the step (mm), `kick` and `drift` those of advance() (s). Returns the
// force of the grip along its motion (N), the sum of R . dx/d(displacement) with R = m (v - v_free) / kick, which
// includes the inertia of its own nodes; adds to `sum_change` what the prescribed velocities change in the sum of m
// v0^2.
double apply_grip(const Grip& grip, const PackedMesh& packed, State& state, double from, double to, double kick,
                  double drift, double& sum_change);

}  // namespace weaveform
