// What else acts on the nodes beside the woven net of yarns and shear cells: bending, contact with tools, frame
// members. Each is one object that the analysis asks in a fixed order, so that a scene pays only for what it has.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

class ForceTerm {
public:
  ForceTerm() = default;
  virtual ~ForceTerm() = default;
  ForceTerm(const ForceTerm&) = delete;
  ForceTerm& operator=(const ForceTerm&) = delete;

  // For messages and the energy table.
  [[nodiscard]] virtual std::string name() const = 0;
  // Adds forces (N) at state.position, state.velocity and state.time to state.force; `step` is the length of the step
  // about to be taken (s). Called once per step, in time order.
  virtual void add_forces(State& state, double step) = 0;
  // mJ; energy stored at the positions of the last add_forces.
  [[nodiscard]] virtual double stored_energy() const { return 0.0; }
  // mJ; kinetic energy that is not the nodes' own (rotations, guided tools).
  [[nodiscard]] virtual double kinetic_energy() const { return 0.0; }
  // mJ; work lost so far (friction, damping).
  [[nodiscard]] virtual double dissipated() const { return 0.0; }
  // mJ; work put in so far from outside (moving tools, binder force, gravity).
  [[nodiscard]] virtual double external_work() const { return 0.0; }
  // Adds, per mesh node, a bound of its stiffness row sums (N/mm): sum over j of |K_ij|. `fabric_frequency` (1/s) is
  // the greatest of the woven net alone.
  virtual void add_stiffness_bound(const std::vector<Vec3>& /*position*/, double /*fabric_frequency*/,
                                   std::vector<double>& /*bound*/) const {}
  // s; above it the term's own unknowns are not stable.
  [[nodiscard]] virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }
  // What a checkpoint must keep: everything that is not computed anew from positions and time before it is asked for.
  // As long for every state. recall gets a list of that length, and throws FileError ("NAME: why") when it holds
  // something that no memory of this term can.
  [[nodiscard]] virtual std::vector<double> memory() const { return {}; }
  virtual void recall(const std::vector<double>& /*memory*/) {}
};

}  // namespace weaveform
