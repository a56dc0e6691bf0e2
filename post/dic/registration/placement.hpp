// Where the measurement lies on the blank: a rotation and a shift of the plane (no scale: a wrong pixel size must
// show).
#pragma once

#include <string>
#include <vector>

#include "post/dic/settings/settings.hpp"
#include "post/dic/virtual/rigid_motion.hpp"
#include "post/dic/virtual/simulation.hpp"

namespace weaveform::dic {

struct Placement {
  RigidMotion reference;                        // of the undeformed specimen
  RigidMotion current;                          // of the deformed one: the same unless the specimen moved as a whole
  std::string method;                           // what was done, in words
  double residual = 0.0;                        // mm; rms of marks or displacements left
  int used = 0, rejected = 0, off_fabric = 0;   // points or marks
  double angle_error = 0.0, shift_error = 0.0;  // rad, mm; standard errors (least squares)
};

// By the settings; least squares matches the displacement field of one stage, seen through facets of `facet_size` (mm).
// Throws InputError with the question when
// the field does not decide the placement.
[[nodiscard]] Placement place(const MeasuredStage& stage, const Simulation& simulation, const SimulatedState& state,
                              const RegistrationSpec& spec, double facet_size);

// With a known reference placement, the motion as a whole of another stage (RegistrationSpec::motion = "free").
[[nodiscard]] RigidMotion follow(const MeasuredStage& stage, const Simulation& simulation, const SimulatedState& state,
                                 const RigidMotion& reference, double reject);

// Rotation and shift that take `from` to `to` with the least squares (Kabsch 1976, in the plane).
[[nodiscard]] RigidMotion rigid_fit(const std::vector<Vec2>& from, const std::vector<Vec2>& to);

}  // namespace weaveform::dic
