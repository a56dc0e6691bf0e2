// Bending without unknowns of its own: beams' yarns (the paper's B31) and rotation-free cells. Curvatures come from the
// lattice: along warp and weft at every crossing (yarn_bend.hpp), twist in every cell (bend_kernels.hpp). Both families
// turn freely against each other, so trellis shear stays unresisted to the last bit that rounding leaves.
//
// Stable step: a bend of stiffness B over elements a and b adds B/l |v_i| sum_j |v_j| to node i's row sum, v = (1/a,
// -(1/a + 1/b), 1/b): 16 B/L^3 in an even lattice, 1e-4 of a PW yarn's 4 E A/L.
//
// Subcycling. So soft a force need not be computed at every step: every n-th step it acts as an impulse of n steps (the
// impulse method of Tuckerman, Berne & Martyna 1992), which is stable as if it were n^2 times as stiff. Unlike a force
// kept over n steps it makes no energy.
//
// Friction in bending (bend_friction.hpp) has a state at every crossing, which is brought up to the positions before the
// forces are taken; without friction none of it is there.
#pragma once

#include <memory>

#include "solver/bending/bends.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/state/actor.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/team.hpp"

namespace weaveform {

class LatticeBending : public Actor {
public:
  // `held`: as for find_bends. `state` must outlive the term. `every`: steps (by state.step) from one impulse to the
  // next. Throws InputError when a moment law has more pieces or a higher degree than the inner loop takes, and
  // for friction with every > 1.
  LatticeBending(const Mesh& mesh, const PackedMesh& packed, const Flexure& flexure, const std::vector<char>& held,
                 const State& state, Team& team, int every = 1);
  ~LatticeBending() override;
  [[nodiscard]] std::string name() const override { return "bending"; }
  void add_forces(State& state, double step) override;
  [[nodiscard]] StoredEnergy stored_energy() const override;
  [[nodiscard]] EnergyFlow energy_flow() const override;  // what friction in bending lost
  void archive(Archive& archive) override;
  void add_stiffness_bound(const std::vector<Vec3>& position, double fabric_frequency,
                           std::vector<double>& bound) const override;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace weaveform
