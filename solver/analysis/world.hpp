// The world of an analysis: plies, the tools that touch them, and their common clock. It knows the theory's order of a
// step (stable step, forces, motion, energies) and nothing of files, histories or verdicts, which are the observers'.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/analysis/balance.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/contact/contact.hpp"
#include "solver/contact/ply_contact.hpp"
#include "solver/contact/rigid_tools.hpp"
#include "solver/contact/sheared_thickness.hpp"
#include "solver/ply/ply.hpp"

namespace weaveform {

// A ply before it is one; all must outlive the world.
struct PlyInput {
  const Mesh& whole;
  const SymmetricPart* part = nullptr;
  const Card& card;
  const Scene& scene;                        // its model, grips and frame
  const std::vector<Tool>* tools = nullptr;  // at this ply's own distance from them; none: the world's
};

// `scene` says analysis, tools and output; `tools` are those of the scene in its order, made (mesher/tools/tool.hpp).
// Plies are all the same part of their wholes.
struct WorldSetup {
  std::vector<PlyInput> plies;
  std::vector<Tool> tools;
  const Scene& scene;
  Loading loading;
  // Of each pair of plies, which then touch (ply_contact.hpp); none: they do not know of each other.
  std::function<PairLaw(int lower, int upper)> pair_law = nullptr;
  std::vector<std::string> ply_names = {};                        // for messages
  double longest_step = std::numeric_limits<double>::infinity();  // s; none is taken that is longer
  Team& team;
};

class World {
public:
  // Throws InputError when a ply cannot be made, starts inside a tool or another ply, or a pushed tool is too light.
  explicit World(const WorldSetup& setup);

  [[nodiscard]] std::size_t size() const { return plies_.size(); }
  // That the plies are looked at with: one each, where nobody else has work for it.
  [[nodiscard]] Team& team() const { return team_; }
  [[nodiscard]] Ply& ply(std::size_t number) { return *plies_[number]; }
  [[nodiscard]] const Ply& ply(std::size_t number) const { return *plies_[number]; }
  // Null without tools.
  [[nodiscard]] const RigidTools* tools() const { return tools_.get(); }
  [[nodiscard]] const Contact* contact(std::size_t ply) const { return tools_ ? contacts_[ply] : nullptr; }
  // Null where plies do not know of each other.
  [[nodiscard]] const PlyContact* ply_contact() const { return ply_contact_.get(); }
  [[nodiscard]] int parts() const { return parts_; }  // the whole is this many times what is solved

  [[nodiscard]] double time() const { return plies_.front()->state().time; }         // s
  [[nodiscard]] std::int64_t steps() const { return plies_.front()->state().step; }  // taken so far
  [[nodiscard]] double duration() const { return duration_; }                        // s
  [[nodiscard]] bool finished() const { return time() >= duration_ * (1.0 - 1e-12); }

  // The start of a run: perturbed positions, step, forces, energies.
  void start();
  // The longest stable step of all plies and tools, with what yarns have reached.
  void renew_step();
  [[nodiscard]] const StableStep& stable_step() const { return stable_; }
  // Of plies that touch each other: what makes the stable step come to nothing, so that the run has no end, in words; ""
  // where it does not.
  [[nodiscard]] std::string endless_run() const;
  [[nodiscard]] double step() const { return step_; }                    // s; the next
  [[nodiscard]] double smallest_step() const { return smallest_step_; }  // s; so far
  [[nodiscard]] const std::string& step_set_by() const { return step_set_by_; }
  // Whether the step must be renewed at once, for yarns come to strains beyond what it allows, or plies press each other
  // that had not. Once after every computation of forces.
  [[nodiscard]] bool passes_reach();
  // While yarns have kept to what is allowed for some steps (while they snap, one step after another is too long for the
  // next) their first strain beyond may wait for the end of the motion, for it lies two steps ahead: forces and motion
  // can then be one pass. Whether it must be renewed then.
  [[nodiscard]] bool is_calm() const;
  [[nodiscard]] bool passed_reach() const;

  // One step with the forces at hand; energies and grip forces are then known for its beginning. With `last` the clock
  // and positions stay.
  void advance(bool last);
  // Forces, at the present positions and time.
  void compute_forces();
  // Without contact and other actors, forces and the step from there can be one pass over memory, with the bits of
  // compute_forces() and advance(false).
  [[nodiscard]] bool moves_in_one_pass() const;
  void compute_forces_and_advance();

  // Of the whole: kinetic energy, losses and outside work at the beginning of the last step, internal energy at the
  // last look.
  [[nodiscard]] const EnergyBalance& balance() const { return balance_; }
  void look_at_stored_energy();
  void note_greatest_energy() { balance_.note_greatest(); }
  [[nodiscard]] double kick() const { return plies_.front()->kick(); }  // s

  // The whole state; read into a world made from the same scene.
  void archive(Archive& archive);

private:
  void make_tools(const WorldSetup& setup);
  void make_ply_contact(const WorldSetup& setup);
  [[nodiscard]] double begin_step(bool last);
  void end_step(double step);
  void close_balance();

  std::vector<std::unique_ptr<Ply>> plies_;
  std::vector<std::unique_ptr<ShearedThickness>> sheared_;  // of each ply, null where it has the card's thickness
  std::unique_ptr<PlyContact> ply_contact_;
  std::unique_ptr<RigidTools> tools_;
  std::vector<Contact*> contacts_;                   // of each ply, which owns it
  std::vector<const std::vector<ToolLoad>*> loads_;  // theirs
  const Scene& scene_;
  double duration_, longest_step_;  // s
  int parts_;
  Team& team_;
  StableStep stable_;
  double step_ = 0.0, step_before_ = 0.0, smallest_step_ = 0.0;  // s
  double viscous_time_ = 0.0;                                    // s; beta of yarn.hpp
  std::string step_set_by_;
  std::int64_t calm_for_ = 0;  // steps since yarns were beyond what was allowed
  EnergyBalance balance_;
};

}  // namespace weaveform
