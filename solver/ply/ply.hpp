// A ply: one layer of fabric with everything that it is and has by itself. Its woven net of yarns and shear cells, the
// actors on it (bending, shells, weight, frame members; contact is added by the world), the grips, ties and mirror
// planes that hold it, its stable step, its energies, and its state.
//
// What is solved may be a half or quarter of the whole (mesher/symmetry/cut_part.hpp). Forces, masses and energies here
// are those of what is solved; positions, fields and grip forces are also given for the whole.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/symmetry/cut_part.hpp"
#include "solver/bending/shell.hpp"
#include "solver/constraint/holds.hpp"
#include "solver/constraint/mirror_planes.hpp"
#include "solver/constraint/ties.hpp"
#include "solver/coupling/tension_shear.hpp"
#include "solver/lattice/forces.hpp"
#include "solver/ply/critical_step.hpp"
#include "solver/ply/energy.hpp"
#include "solver/ply/motion.hpp"
#include "solver/ply/reach.hpp"
#include "solver/ply/torn_yarns.hpp"
#include "solver/state/actor.hpp"

namespace weaveform {

// Mesh, part, scene, card and team must outlive the ply.
struct PlySetup {
  const Mesh& whole;
  const SymmetricPart* part = nullptr;  // of `whole`; none: the whole is solved
  const Scene& scene;                   // model, analysis, grips and frame
  const Card& card;
  double duration = 1.0;  // s; of the analysis
  double damping = 0.0;   // 1/s; mass-proportional
  Team& team;
};

class Ply {
public:
  // Throws InputError when a grip has no nodes, a law of the card is too long for the inner loop, or the model lacks a
  // stiffness of the card.
  explicit Ply(const PlySetup& setup);
  Ply(const Ply&) = delete;
  Ply& operator=(const Ply&) = delete;

  [[nodiscard]] const Mesh& whole() const { return whole_; }
  [[nodiscard]] const SymmetricPart* part() const { return part_; }
  [[nodiscard]] const Mesh& mesh() const { return mesh_; }  // what is solved
  [[nodiscard]] const PackedMesh& packed() const { return packed_; }
  [[nodiscard]] const Card& card() const { return card_; }
  [[nodiscard]] const ModelSpec& model() const { return scene_.model; }
  [[nodiscard]] State& state() { return state_; }
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] Holds& holds() { return holds_; }
  [[nodiscard]] const Holds& holds() const { return holds_; }
  [[nodiscard]] const Shell* shell() const { return shell_; }  // null when the cells are none
  [[nodiscard]] double mass() const;                           // tonne

  // Yarns on the flat blank's free nodes moved by up to `size` (mm) in its plane, by the generator's own bits.
  void perturb(double size, std::uint64_t seed);
  // Acts after those the ply has by itself, and is asked for step and energies like them.
  void add(std::unique_ptr<Actor> actor);
  // From a start that is flat (z = 0) and at rest along z, with nothing that pulls out of the plane, a ply moves in the
  // plane alone, with the same bits in three quarters of the time. To be asked for when its state is set, at the start or
  // read from an archive.
  void seek_plane();
  [[nodiscard]] bool is_flat() const { return flat_; }
  // Never again; for who may push nodes out of the plane, or put them there.
  void leave_plane();

  // s; the stable step of yarns and cells alone at the start, with the stiffest tangents; with every node held that of
  // the same ply let go.
  [[nodiscard]] double fabric_step() const { return fabric_step_; }
  // From now on what yarns reached since the last call is allowed (reach.hpp); the longest stable step with that. Where
  // every node is held nothing sets one: a row of history is then as good as any.
  [[nodiscard]] StableStep renew_stable_step();
  // `viscous_time` (s): beta of yarn.hpp; `step` (s): the one to be taken. Again after an archive was read. Forces that
  // are computed before the next motion have the lesser of the viscosities before and after: their kick is half of the
  // step before, and a viscosity for far shorter steps would throw yarns back.
  void set_step(double viscous_time, double step);
  // Whether yarns have come, or come within the next steps, to strains beyond what the step allows, or cells to a shear.
  [[nodiscard]] bool passes_reach();
  // Whether any call since the step was renewed said so.
  [[nodiscard]] bool passed_reach() const { return reach_.passed(); }

  // Forces of everything that acts, given on by what follows others, at state().position and time: its own, and then
  // what else the caller adds in between.
  void compute_own_forces(double step);
  void give_on_forces();
  void compute_forces(double step) {
    compute_own_forces(step);
    give_on_forces();
  }
  // One leapfrog step, grips included (motion.hpp); holds() know their displacements. The last one only tells the
  // velocities and reactions at its beginning: positions stay.
  void advance(double step_before, double step, bool last);
  // Whether nothing but the lattice, grips, ties and mirror planes acts: both may then be one pass over memory.
  [[nodiscard]] bool moves_in_one_pass() const { return actors_.empty(); }
  // compute_forces() and advance() at once, for a step that is not the last; state().force then holds what it needed.
  void compute_forces_and_advance(double step_before, double step);
  [[nodiscard]] double kick() const { return kick_; }  // s; what the last step's grip forces were averaged over

  // Positions that follow what was advanced freely or set by hand.
  void follow();

  // mJ; of everything, at the present positions. Calls must follow the motion in order (energy.hpp).
  [[nodiscard]] StoredEnergy stored_energy();
  // mJ; at the beginning of the last step: of nodes and actors; lost to damping, viscosity and friction; put in by
  // grips and actors.
  [[nodiscard]] EnergyFlow energy_flow() const;

  // What no sound state has: a position that is not a number, a torn yarn, in words; "" where there is none. `advice`
  // says what else than less pull may help.
  [[nodiscard]] std::string trouble(const std::function<std::string()>& advice, bool is_hasty) const;

  [[nodiscard]] std::vector<Vec3> positions() const { return mesh_positions(packed_, state_); }
  [[nodiscard]] std::vector<Vec3> whole_positions() const;  // mm; per node of the whole

  void archive(Archive& archive);

private:
  void add_own_actors(const PlySetup& setup);
  [[nodiscard]] bool lies_flat() const;
  void set_flat(bool flat);
  void note_motion(const Motion::Outcome& outcome, double step_before);
  [[nodiscard]] std::string lost_position(const std::function<std::string()>& advice) const;
  [[nodiscard]] std::string torn_yarn(const std::function<std::string()>& advice, bool is_hasty) const;

  const Mesh& whole_;
  const SymmetricPart* part_;
  const Mesh& mesh_;
  const Scene& scene_;
  const Card& card_;
  double duration_, damping_;

  std::array<TangentLaw, 2> yarn_laws_;
  PackedMesh packed_;
  std::unique_ptr<Ties> ties_;             // null when no node follows others, or a rigid frame moves them all
  std::unique_ptr<MirrorPlanes> mirrors_;  // null when the whole is solved
  State state_;
  Holds holds_;
  FabricForces forces_;
  CriticalStep critical_step_;
  InternalEnergy internal_energy_;
  Motion motion_;
  Reach reach_;
  YarnLimits yarn_limits_;
  std::vector<std::unique_ptr<Actor>> actors_;
  const Shell* shell_ = nullptr;            // one of them
  const TensionShear* coupling_ = nullptr;  // likewise
  double fabric_step_ = 0.0;                // s
  bool flat_ = false, stays_in_space_ = false;

  std::array<double, 2> yarn_modulus_ = {0.0, 0.0};  // MPa; that the step is stable with, of each family
  double kinetic_ = 0.0, damping_work_ = 0.0;        // mJ
  double damping_power_before_ = 0.0;                // mJ/s
  double kick_ = 0.0;                                // s
  std::array<double, 2> viscosity_ = {0.0, 0.0};     // MPa s; of each family, from the next motion on
};

}  // namespace weaveform
