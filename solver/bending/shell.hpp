// Shell cells: directors with velocities of their own (shell_edge.hpp), their motion, inertia and energy.
//
// Rotary inertia is rho t^3/12 per area, raised at a node where it would set the stable step: at least
// 1.5 K dt^2/4 with K the node's rotational row sum and dt the fabric's step (as the explicit codes do, Hughes, Cohen &
// Haroun 1978). The greatest factor is reported. Grips that hold every component clamp the directors.
#pragma once

#include <memory>

#include "solver/bending/flexure.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

class Shell : public Actor {
public:
  struct Setup {
    double fabric_step = 0.0;  // s; stable step without the shell
    double damping = 0.0;      // 1/s; mass-proportional
    Team& team;
  };
  // `clamped`: per mesh node. `state` must outlive the term and hold the start, from which directors are the normals.
  Shell(const Mesh& mesh, const PackedMesh& packed, const Card& card, const Flexure& flexure,
        const std::vector<char>& clamped, const State& state, const Setup& setup);
  ~Shell() override;
  [[nodiscard]] std::string name() const override { return "shell"; }
  void add_forces(State& state, double step) override;
  [[nodiscard]] StoredEnergy stored_energy() const override;
  [[nodiscard]] EnergyFlow energy_flow() const override;
  void add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                           std::vector<double>& bound) const override;
  [[nodiscard]] double longest_step() const override;
  void archive(Archive& archive) override;

  // 1; greatest factor on a node's rotary inertia.
  [[nodiscard]] double inertia_scale() const;
  // Per mesh node; for output and tests.
  [[nodiscard]] std::vector<Vec3> directors() const;
  void set_directors(const std::vector<Vec3>& director);
  // 1/s; per mesh node, perpendicular to the director.
  void set_director_velocities(const std::vector<Vec3>& velocity);
  // N mm per radian; gradient of the energy by the directors at the last add_forces, per mesh node, with its sign
  // turned.
  [[nodiscard]] std::vector<Vec3> director_forces() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace weaveform
