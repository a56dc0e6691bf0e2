// A chain of yarn elements without cells, moved by the solver's own parts: forces, stable step, leapfrog, grips,
// energy. It hangs from its first node; the others are free masses. Units mm, s, N, MPa, tonne.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "fabric/card/card.hpp"
#include "solver/lattice/forces.hpp"
#include "solver/ply/critical_step.hpp"
#include "solver/ply/energy.hpp"
#include "solver/ply/gravity.hpp"
#include "solver/ply/motion.hpp"
#include "solver/result/fields.hpp"

namespace weaveform::test {

// `elements` warp elements of rest length `length` (mm), straight along x from the origin; `mass` (tonne) at every
// node.
inline Mesh chain_mesh(int elements, double length, double section, double mass) {
  Mesh mesh;
  mesh.spacing = {length, length};
  mesh.lattice_size = {elements + 1, 1};
  mesh.thickness = 1.0;
  for (int n = 0; n <= elements; ++n) mesh.nodes.add({n * length, 0.0, 0.0}, mass, {n, 0});
  for (int e = 0; e < elements; ++e) mesh.yarns.add({.node = {e, e + 1}, .rest_length = length, .section = section});
  return mesh;
}

// Axial force (N, tension positive) of one element of `law` at true strain e: minus what it does to its second node.
inline double element_force(const Card& card, const ModelSpec& model, const std::array<TangentLaw, 2>& laws,
                            double length, double section, double strain) {
  const Mesh mesh = chain_mesh(1, length, section, 1.0);
  const PackedMesh packed = pack_mesh(mesh);
  State state = initial_state(packed, mesh);
  state.position[0][packed.packed_of_mesh[1]] = length * std::exp(strain);
  FabricForces forces(packed, card, laws, model, state, alone());
  forces.compute(state);
  return -state.force[0][packed.packed_of_mesh[1]];
}

class Chain {
public:
  // `place` gives each node's start position.
  Chain(Mesh mesh, const Card& card, const ModelSpec& model, double viscosity, double step_factor, const Vec3& gravity,
        const std::function<Vec3(int)>& place)
      : mesh_(std::move(mesh)),
        packed_(pack_mesh(mesh_)),
        state_(initial_state(packed_, mesh_)),
        laws_(yarn_laws(card, model)),
        forces_(packed_, card, laws_, model, state_, alone()),
        elastic_(packed_, card, laws_, model, state_, alone()),
        energy_(mesh_, card, laws_, model),
        critical_(mesh_, card, laws_, model, held()),
        motion_(packed_, forces_.bands(), std::vector<char>(packed_.nodes, 0), 0.0, alone()),
        viscosity_(viscosity),
        factor_(step_factor) {
    for (int n = 0; n < mesh_.node_count(); ++n)
      for (int c = 0; c < 3; ++c) state_.position[c][packed_.packed_of_mesh[n]] = place(n)[c];
    gravity_ = std::make_unique<Gravity>(packed_, state_, gravity);
    Grip top;
    top.name = "top";
    top.node = {packed_.packed_of_mesh[0]};
    top.start = {place(0)};
    top.held = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    top.velocity_before.resize(1);
    grips_.push_back(top);
    start_ = energy_(positions());
    was_taut_.assign(mesh_.yarn_count(), 0);
  }

  // One step; the energies are those of its beginning.
  void advance() {
    if (steps_ % 500 == 0) renew_step();  // as often as the analysis does
    elastic_.compute(state_);
    Components viscous = state_.force, middle = state_.velocity;
    forces_.compute(state_);
    for (int c = 0; c < 3; ++c)
      for (std::size_t n = 0; n < viscous[c].size(); ++n) viscous[c][n] = state_.force[c][n] - viscous[c][n];
    gravity_->add_forces(state_, step_);
    kinetic_ = motion_.advance(state_, grips_, {0.0}, {0.0}, step_before_, step_).kinetic;
    // leapfrog: m (v+^2 - v-^2)/2 = kick f.(v- + v+)/2, so that this is what the viscosity takes, to rounding
    double work = 0.0;
    for (int c = 0; c < 3; ++c)
      for (std::size_t n = 0; n < viscous[c].size(); ++n)
        work -= 0.5 * (step_before_ + step_) * viscous[c][n] * 0.5 * (middle[c][n] + state_.velocity[c][n]);
    damping_ = damping_after_ + 0.5 * work;  // at the step's beginning, half of the kick done
    damping_after_ += work;
    step_before_ = step_;
    time_ += step_;
    ++steps_;
    count_switches();
  }

  // mJ; at the last step's beginning, whose positions are those before it
  struct Balance {
    double kinetic, internal, weight, damping, start;
    // K + U - W + D - start: what was made (positive) or lost
    [[nodiscard]] double made() const { return kinetic + internal - weight + damping - start; }
  };
  // Takes one step and balances the state it began with.
  Balance advance_and_balance() {
    const double internal = energy_(positions());
    advance();
    return {kinetic_, internal, gravity_->energy_flow().put_in, damping_, start_};
  }

  [[nodiscard]] std::vector<Vec3> positions() const { return mesh_positions(packed_, state_); }
  [[nodiscard]] double time() const { return time_; }
  [[nodiscard]] long steps() const { return steps_; }
  // Times any element went from slack to taut.
  [[nodiscard]] long switches() const { return switches_; }

private:
  [[nodiscard]] std::vector<char> held() const {
    std::vector<char> held(mesh_.node_count(), 0);
    held[0] = 1;
    return held;
  }

  void renew_step() {
    const double stable = critical_(positions(), critical_.stiffest(every_strain)).step;
    const double eta = viscosity_ * stable * critical_.stiffest(every_strain)[0];
    forces_.set_viscosity({eta, eta});
    step_ = factor_ * stable * (std::sqrt(1.0 + viscosity_ * viscosity_) - viscosity_);
  }

  void count_switches() {
    const auto x = positions();
    for (int e = 0; e < mesh_.yarn_count(); ++e) {
      const Vec3 &a = x[mesh_.yarns.node[e][0]], &b = x[mesh_.yarns.node[e][1]];
      const double length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
      const char taut = laws_[0].stress(std::log(length / mesh_.yarns.rest_length[e])) > 0.0 ? 1 : 0;
      switches_ += taut > was_taut_[e] ? 1 : 0;
      was_taut_[e] = taut;
    }
  }

  Mesh mesh_;
  PackedMesh packed_;
  State state_;
  std::array<TangentLaw, 2> laws_;
  FabricForces forces_, elastic_;  // with and without viscosity
  InternalEnergy energy_;
  CriticalStep critical_;
  Motion motion_;
  std::unique_ptr<Gravity> gravity_;
  std::vector<Grip> grips_;
  std::vector<char> was_taut_;
  double viscosity_, factor_;
  double step_ = 0.0, step_before_ = 0.0, time_ = 0.0;                  // s
  double kinetic_ = 0.0, damping_ = 0.0, damping_after_ = 0.0, start_;  // mJ
  long steps_ = 0, switches_ = 0;
};

}  // namespace weaveform::test
