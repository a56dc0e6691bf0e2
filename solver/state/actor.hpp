// What acts on a ply beside its woven net of yarns and shear cells: bending, shells, weight, frame members, contact.
// Each is one object that the ply asks in a fixed order, so that a scene pays only for what it has.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "core/vector/vector.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// mJ; at the positions of the last forces. Asked for at output times only, for it may be dear.
struct StoredEnergy {
  double total = 0.0;
  double bending = 0.0;    // part of the total
  double hourglass = 0.0;  // part of bending that one point per cell would not see
};

// mJ; asked for at every step.
struct EnergyFlow {
  double kinetic = 0.0;           // that is not the nodes' own (rotations, guided tools)
  double lost = 0.0;              // so far: friction, damping
  double put_in = 0.0;            // so far, from outside: moving tools, binder force, weight
  double bending_friction = 0.0;  // part of `lost`

  void add(const EnergyFlow& more) {
    kinetic += more.kinetic;
    lost += more.lost;
    put_in += more.put_in;
    bending_friction += more.bending_friction;
  }
};

class Actor {
public:
  Actor() = default;
  virtual ~Actor() = default;
  Actor(const Actor&) = delete;
  Actor& operator=(const Actor&) = delete;

  // For messages and the energy table.
  [[nodiscard]] virtual std::string name() const = 0;
  // Adds forces (N) at state.position, state.velocity and state.time to state.force; `step` is the length of the step
  // about to be taken (s). Called once per step, in time order.
  virtual void add_forces(State& state, double step) = 0;
  [[nodiscard]] virtual StoredEnergy stored_energy() const { return {}; }
  [[nodiscard]] virtual EnergyFlow energy_flow() const { return {}; }
  // Adds, per mesh node, a bound of its stiffness row sums (N/mm): sum over j of |K_ij|. `fabric_frequency` (1/s) is
  // the greatest of the woven net alone.
  virtual void add_stiffness_bound(const std::vector<Vec3>& /*position*/, double /*fabric_frequency*/,
                                   std::vector<double>& /*bound*/) const {}
  // s; above it the actor's own unknowns are not stable.
  [[nodiscard]] virtual double longest_step() const { return std::numeric_limits<double>::infinity(); }
  // Everything that is not computed anew from positions and time before it is asked for.
  virtual void archive(Archive& /*archive*/) {}
};

}  // namespace weaveform
