#include "solver/analysis/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/contact/fabric_stiffness.hpp"

namespace weaveform {
namespace {

// A perturbed start snaps taut and slack at once, and nearly all of its energy goes within the first oscillations of the
// stiffest yarns. The balance is weakest there: off by 12 to 18 % of that energy at the full step, by less than 1 % at a
// quarter of it.
constexpr std::int64_t settling_steps = 500;
constexpr double settling_share = 0.25;
constexpr std::int64_t calm_steps = 10;    // without a yarn beyond what the step allows
constexpr double least_step_share = 1e-4;  // of the plies' own at the start: a run of a shorter one has no end

// What contact with other plies means for a ply's stable step.
class StackedPly : public Actor {
public:
  StackedPly(const PlyContact& contact, int ply) : contact_(contact), ply_(ply) {}
  [[nodiscard]] std::string name() const override { return "contact between plies"; }
  void add_forces(State& /*state*/, double /*step*/) override {}  // the world asks the contact of all
  void add_stiffness_bound(const std::vector<Vec3>& /*position*/, double fabric_frequency,
                           std::vector<double>& bound) const override {
    contact_.add_stiffness_bound(ply_, fabric_frequency, bound);
  }

private:
  const PlyContact& contact_;
  int ply_;
};

}  // namespace

World::World(const WorldSetup& setup)
    : scene_(setup.scene),
      duration_(setup.loading.duration),
      longest_step_(setup.longest_step),
      parts_(setup.plies.front().part != nullptr ? setup.plies.front().part->mesh.symmetry.parts() : 1),
      team_(setup.team) {
  for (const auto& input : setup.plies)
    plies_.push_back(std::make_unique<Ply>(PlySetup{.whole = input.whole,
                                                    .part = input.part,
                                                    .scene = input.scene,
                                                    .card = input.card,
                                                    .duration = duration_,
                                                    .damping = setup.loading.damping,
                                                    .team = setup.team}));
  for (std::size_t k = 0; k < plies_.size(); ++k)
    sheared_.push_back(
        plies_[k]->model().contact_thickness == ContactThickness::sheared
            ? std::make_unique<ShearedThickness>(plies_[k]->mesh(), plies_[k]->packed(), plies_[k]->state())
            : nullptr);
  if (setup.pair_law && plies_.size() > 1) make_ply_contact(setup);
  if (!setup.tools.empty()) make_tools(setup);
}

void World::make_ply_contact(const WorldSetup& setup) {
  double step = std::numeric_limits<double>::infinity();
  std::vector<Ply*> plies;
  std::vector<ShearedThickness*> sheared;
  for (auto& one : sheared_) sheared.push_back(one.get());
  for (auto& ply : plies_) {
    plies.push_back(ply.get());
    step = std::min(step, ply->fabric_step());
  }
  ply_contact_ = std::make_unique<PlyContact>(PlyContactSetup{.plies = plies,
                                                              .names = setup.ply_names,
                                                              .law = setup.pair_law,
                                                              .frequency = contact_frequency(scene_.analysis, step),
                                                              .sheared = sheared,
                                                              .team = setup.team});
  for (std::size_t k = 0; k < plies_.size(); ++k)
    plies_[k]->add(std::make_unique<StackedPly>(*ply_contact_, static_cast<int>(k)));
}

void World::make_tools(const WorldSetup& setup) {
  std::vector<SprungPly> sprung;
  std::optional<double> curved_after;
  if (scene_.analysis.curved_contact) curved_after = curved_onset * duration_;
  for (const auto& ply : plies_)
    sprung.push_back(
        {.mass = ply->mass(),
         .frequency = tool_contact_frequency(scene_.analysis, setup.plies[sprung.size()].card, ply->fabric_step()),
         .fabric_frequency = 2.0 / ply->fabric_step(),
         .curved_after = curved_after});
  double least_spacing = std::numeric_limits<double>::infinity();
  for (const auto& ply : plies_)
    least_spacing = std::min({least_spacing, ply->mesh().spacing[0], ply->mesh().spacing[1]});
  tools_ = std::make_unique<RigidTools>(setup.tools, scene_, plies_.front()->mesh().symmetry, least_spacing, duration_,
                                        sprung);
  for (std::size_t k = 0; k < plies_.size(); ++k) {
    Ply& ply = *plies_[k];
    auto contact = std::make_unique<Contact>(ply.mesh(), ply.packed(), ply.state(), sprung[k], *tools_, setup.team,
                                             setup.plies[k].tools, sheared_[k].get());
    contacts_.push_back(contact.get());
    loads_.push_back(&contact->loads());
    ply.add(std::move(contact));
  }
}

void World::start() {
  if (const double size = scene_.analysis.perturbation; size > 0.0)
    for (std::size_t k = 0; k < plies_.size(); ++k)  // each ply its own
      plies_[k]->perturb(size, static_cast<std::uint64_t>(scene_.analysis.perturbation_seed) + k);
  for (auto& ply : plies_) ply->seek_plane();
  renew_step();
  compute_forces();
  if (passes_reach()) renew_step();
  look_at_stored_energy();
  balance_.start = balance_.internal;
}

void World::renew_step() {
  if (ply_contact_) ply_contact_->renew_bound();
  stable_ = {.step = std::numeric_limits<double>::infinity(), .set_by = ""};
  std::vector<StableStep> own(plies_.size());
  team_.run(static_cast<int>(plies_.size()), [&](int k) { own[k] = plies_[k]->renew_stable_step(); });
  for (StableStep& of_ply : own)
    if (of_ply.step < stable_.step) stable_ = std::move(of_ply);
  if (tools_ && tools_->longest_step() < stable_.step) stable_ = {tools_->longest_step(), "contact"};
  // with every node held nothing sets a step; a row of history is then as good as any
  if (!std::isfinite(stable_.step)) stable_.step = duration_ / scene_.output.history;
  if (longest_step_ < stable_.step) stable_ = {longest_step_, "longest step asked for"};
  // viscosity of fraction xi at the highest frequency 2/step shortens the stable step to (sqrt(1 + xi^2) - xi) of it
  const double xi = scene_.analysis.yarn_viscosity;
  viscous_time_ = xi * stable_.step;
  stable_.step *= std::sqrt(1.0 + xi * xi) - xi;
  step_ = scene_.analysis.step_factor * stable_.step;
  if (scene_.analysis.perturbation > 0.0 && steps() < settling_steps) step_ *= settling_share;
  for (auto& ply : plies_) ply->set_step(viscous_time_, step_);
  if (smallest_step_ == 0.0 || step_ < smallest_step_) {
    smallest_step_ = step_;
    step_set_by_ = stable_.set_by;
  }
}

// Plies may come to that where they are pressed into each other so that single nodes bear what whole cells should.
std::string World::endless_run() const {
  if (!ply_contact_) return "";
  double own = std::numeric_limits<double>::infinity();
  for (const auto& ply : plies_) own = std::min(own, ply->fabric_step());
  if (stable_.step >= least_step_share * own) return "";
  return fmt::format(
      "the stable step has come down to {:.3g} s from the {:.3g} s of the plies alone, set by the {}; load more "
      "slowly, "
      "see whether the tools leave room for the stack, or make blank.coarsening smaller",
      stable_.step, own, stable_.set_by);
}

bool World::passes_reach() {
  const bool was_calm = is_calm();
  bool yarns_pass = false;
  for (auto& ply : plies_) yarns_pass = ply->passes_reach() || yarns_pass;  // each notes its strains
  calm_for_ = yarns_pass ? 0 : std::min(calm_for_ + 1, calm_steps);
  return (yarns_pass && !was_calm) || (ply_contact_ && ply_contact_->passes_bound());
}

bool World::is_calm() const {
  return calm_for_ >= calm_steps;
}

bool World::passed_reach() const {
  return std::any_of(plies_.begin(), plies_.end(), [](const auto& ply) { return ply->passed_reach(); });
}

void World::compute_forces() {
  if (tools_) tools_->advance(time());
  for (std::size_t k = 0; k < plies_.size(); ++k)
    if (sheared_[k]) sheared_[k]->look(plies_[k]->state(), team_);
  for (auto& ply : plies_) ply->compute_own_forces(step_);
  if (ply_contact_) ply_contact_->add_forces();
  for (std::size_t k = 0; k < plies_.size(); ++k)
    if (sheared_[k]) sheared_[k]->add_forces(plies_[k]->state());
  for (auto& ply : plies_) ply->give_on_forces();
  if (!tools_) return;
  tools_->gather(loads_);
}

// Grips know the way they have to go; returns the step's length, s.
double World::begin_step(bool last) {
  const double now = time(), step = last ? step_ : std::min(step_, duration_ - now);
  for (auto& ply : plies_) ply->holds().set_displacements(now / duration_, (now + step) / duration_);
  return step;
}

void World::end_step(double step) {
  const double after = time() + step;
  for (auto& ply : plies_) {
    State& state = ply->state();
    state.time = after >= duration_ ? duration_ : after;
    ++state.step;
  }
  step_before_ = step;
}

void World::advance(bool last) {
  const double step = begin_step(last);
  for (auto& ply : plies_) ply->advance(step_before_, step, last);
  close_balance();
  if (!last) end_step(step);
}

bool World::moves_in_one_pass() const {
  return !ply_contact_ &&
         std::all_of(plies_.begin(), plies_.end(), [](const auto& ply) { return ply->moves_in_one_pass(); });
}

void World::compute_forces_and_advance() {
  const double step = begin_step(false);
  for (auto& ply : plies_) ply->compute_forces_and_advance(step_before_, step);
  close_balance();
  end_step(step);
}

// Everything but the internal energy, which only output times need.
void World::close_balance() {
  EnergyFlow sum;
  for (const auto& ply : plies_) sum.add(ply->energy_flow());
  if (ply_contact_) sum.add(ply_contact_->energy_flow());
  if (tools_) sum.add(tools_->energy_flow());
  balance_.kinetic = parts_ * sum.kinetic;
  balance_.damping = parts_ * sum.lost;
  balance_.external = parts_ * sum.put_in;
  balance_.bending_friction = parts_ * sum.bending_friction;
}

void World::look_at_stored_energy() {
  std::vector<StoredEnergy> own(plies_.size());
  team_.run(static_cast<int>(plies_.size()), [&](int k) { own[k] = plies_[k]->stored_energy(); });
  StoredEnergy sum;
  for (const StoredEnergy& energy : own) {
    sum.total += energy.total;
    sum.bending += energy.bending;
    sum.hourglass += energy.hourglass;
  }
  if (ply_contact_) sum.total += ply_contact_->stored_energy().total;
  if (tools_) sum.total += tools_->stored_energy().total;
  balance_.internal = parts_ * sum.total;
  balance_.bending = parts_ * sum.bending;
  balance_.hourglass = parts_ * sum.hourglass;
}

void World::archive(Archive& archive) {
  archive.number("a step's length", step_, {.least = std::numeric_limits<double>::min()});
  archive.number("a step's length", step_before_, not_negative);
  archive.number("a step's length", smallest_step_, {.least = std::numeric_limits<double>::min()});
  archive.text("what set the step", step_set_by_);
  archive.number("a viscous time", viscous_time_, not_negative);
  archive.count("a number of calm steps", calm_for_, 0, calm_steps);
  for (double* energy : {&balance_.internal, &balance_.kinetic, &balance_.damping, &balance_.external,
                         &balance_.bending, &balance_.hourglass, &balance_.start, &balance_.greatest})
    archive.number("an energy", *energy);
  for (auto& sheared : sheared_)
    if (sheared) sheared->archive(archive);
  if (ply_contact_) ply_contact_->archive(archive);
  if (tools_) tools_->archive(archive);
  for (auto& ply : plies_) {
    ply->archive(archive);
    ply->seek_plane();
    ply->set_step(viscous_time_, step_);
  }
}

}  // namespace weaveform
