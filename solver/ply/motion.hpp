// One leapfrog step of all nodes (central difference with velocities at half steps), grips included.
//   v+ = ((1 - a k/2) v- + k f/m) / (1 + a k/2)     k = (dt_before + dt)/2, a the mass-proportional damping
//   x+ = x + dt v+
#pragma once

#include <vector>

#include "solver/constraint/grips.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

class Motion {
public:
  Motion(const PackedMesh& packed, double damping, Team& team);

  struct Outcome {
    double kinetic = 0.0;            // mJ; at the time of the forces, v0 = (v- + v+)/2
    double kick = 0.0;               // s; what the grip forces were averaged over
    std::vector<double> grip_force;  // N; of each grip along its motion
  };
  // Moves `state` from its time by `step` (s) with the forces in it; grips go from their displacement `from` to `to`
  // (mm). The reference stays valid until the next call.
  const Outcome& advance(State& state, std::vector<Grip>& grips, const std::vector<double>& from,
                         const std::vector<double>& to, double step_before, double step);

private:
  void add_range(Run range);

  const PackedMesh& packed_;
  double damping_;
  Team& team_;
  Doubles inverse_mass_;  // 1/tonne; 0 where no node is
  Doubles mass_;          // tonne; 0 where no node is
  // Packed index ranges that hold all nodes, in chunks that one call moves: chunk k has ranges chunk_[k] to
  // chunk_[k + 1] - 1. Chunks depend on the mesh alone.
  std::vector<int> begin_, end_, chunk_;
  int in_chunk_ = 0;  // nodes of the last chunk
  struct Sums {
    double lane[vector_width];
  };
  std::vector<Sums> sums_;  // of m v0^2, per chunk and lane
  Outcome outcome_;
};

}  // namespace weaveform
