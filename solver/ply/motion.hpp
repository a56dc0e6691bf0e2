// One leapfrog step of all nodes (central difference with velocities at half steps), grips included.
//   v+ = ((1 - a k/2) v- + k f/m) / (1 + a k/2)     k = (dt_before + dt)/2, a the mass-proportional damping
//   x+ = x + dt v+
//
// In two halves: nodes of the lattice that nothing but the lattice pulls at, which may move in the pass that computes
// their forces (lattice/moving_nodes.hpp), and after all forces the others and the grips.
#pragma once

#include <vector>

#include "solver/constraint/grips.hpp"
#include "solver/lattice/moving_nodes.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

class Motion {
public:
  // `waits`: per packed node, whether more than the lattice's elements may pull at it (waiting_nodes()).
  Motion(const PackedMesh& packed, const Bands& bands, const std::vector<char>& waits, double damping, Team& team);

  // Whether nodes move in x and y alone, as where all else along z is zero (lattice/element_loops.hpp). Not until set.
  void set_flat(bool flat) { flat_ = flat; }

  struct Outcome {
    double kinetic = 0.0;            // mJ; at the time of the forces, v0 = (v- + v+)/2
    double kick = 0.0;               // s; what the grip forces were averaged over
    std::vector<double> grip_force;  // N; of each grip along its motion
  };
  // Moves `state` from its time by `step` (s) with the forces in it; grips go from their displacement `from` to `to`
  // (mm). The reference stays valid until the next call.
  const Outcome& advance(State& state, std::vector<Grip>& grips, const std::vector<double>& from,
                         const std::vector<double>& to, double step_before, double step);

  // The same in parts: begin(); the free nodes by FabricForces::compute_and_move() with what begin() returned; finish().
  [[nodiscard]] BandMove begin(State& state, std::vector<Grip>& grips, double step_before, double step);
  const Outcome& finish(State& state, const BandMove& move, std::vector<Grip>& grips, const std::vector<double>& from,
                        const std::vector<double>& to);

private:
  void move_waiting(const BandMove& move, int band);
  const Outcome& settle(State& state, const BandMove& move, std::vector<Grip>& grips, const std::vector<double>& from,
                        const std::vector<double>& to);

  const PackedMesh& packed_;
  const Bands& bands_;
  std::vector<int> share_;  // of each thread, the bands whose forces it computes: its cache has them
  NodesByWaiting blocks_;
  std::vector<int> ends_;  // blocks of the yarn ends, which are in no band
  double damping_;
  bool flat_ = false;
  Team& team_;
  Doubles inverse_mass_;                       // 1/tonne; 0 where no node is
  Doubles mass_;                               // tonne; 0 where no node is
  std::vector<LaneSums> sums_, waiting_sums_;  // of m v0^2, per band; of those that wait and last the yarn ends
  Outcome outcome_;
};

// Per packed node: those that listed elements, grips, ties or mirror planes have to do with.
[[nodiscard]] std::vector<char> waiting_nodes(const Mesh& mesh, const PackedMesh& packed,
                                              const std::vector<Grip>& grips);

}  // namespace weaveform
