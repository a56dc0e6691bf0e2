#include "solver/analysis/world.hpp"

#include <algorithm>
#include <cmath>

namespace weaveform {

World::World(const WorldSetup& setup)
    : scene_(setup.scene),
      duration_(setup.loading.duration),
      longest_step_(setup.longest_step),
      parts_(setup.plies.front().part != nullptr ? setup.plies.front().part->mesh.symmetry.parts() : 1) {
  for (const auto& input : setup.plies)
    plies_.push_back(std::make_unique<Ply>(PlySetup{.whole = input.whole,
                                                    .part = input.part,
                                                    .scene = input.scene,
                                                    .card = input.card,
                                                    .duration = duration_,
                                                    .damping = setup.loading.damping,
                                                    .team = setup.team}));
  if (!setup.tools.empty()) make_tools(setup);
  if (plies_.size() > 1 && setup.pair_law) join_plies(setup);
}

// As stiff as the ply of the smallest step allows: it sets the step of all.
void World::join_plies(const WorldSetup& setup) {
  std::vector<Ply*> plies;
  std::vector<std::string> names;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < plies_.size(); ++k) {
    plies.push_back(plies_[k].get());
    names.push_back(setup.plies[k].name);
    step = std::min(step, plies_[k]->fabric_step());
  }
  between_ = std::make_unique<PlyContact>(PlyContactSetup{.plies = std::move(plies),
                                                          .names = std::move(names),
                                                          .law = setup.pair_law,
                                                          .frequency = contact_frequency(scene_.analysis, step),
                                                          .team = setup.team});
}

void World::make_tools(const WorldSetup& setup) {
  std::vector<SprungPly> sprung;
  for (const auto& ply : plies_)
    sprung.push_back({.mass = ply->mass(),
                      .frequency = contact_frequency(scene_.analysis, ply->fabric_step()),
                      .fabric_frequency = 2.0 / ply->fabric_step()});
  const Mesh& first = plies_.front()->mesh();
  double least_spacing = std::numeric_limits<double>::infinity();
  for (const auto& ply : plies_) least_spacing = std::min({least_spacing, ply->mesh().spacing[0], ply->mesh().spacing[1]});
  tools_ = std::make_unique<RigidTools>(setup.tools, scene_, first.symmetry, least_spacing, duration_, sprung);
  for (std::size_t k = 0; k < plies_.size(); ++k) {
    Ply& ply = *plies_[k];
    auto contact = std::make_unique<Contact>(ply.mesh(), ply.packed(), ply.state(), sprung[k], *tools_, setup.team,
                                             setup.plies[k].tools);
    contacts_.push_back(contact.get());
    loads_.push_back(&contact->loads());
    ply.add(std::move(contact));
  }
}

void World::start() {
  if (const double size = scene_.analysis.perturbation; size > 0.0)
    for (std::size_t k = 0; k < plies_.size(); ++k)  // each ply its own
      plies_[k]->perturb(size, static_cast<std::uint64_t>(scene_.analysis.perturbation_seed) + k);
  renew_step();
  compute_forces();
  if (passes_reach()) renew_step();
  look_at_stored_energy();
  balance_.start = balance_.internal;
}

void World::renew_step() {
  stable_ = {.step = std::numeric_limits<double>::infinity(), .set_by = ""};
  for (std::size_t k = 0; k < plies_.size(); ++k) {
    Ply::StiffnessBound contact;
    if (between_)
      contact = [this, k](double frequency, std::vector<double>& bound) {
        between_->add_stiffness_bound(static_cast<int>(k), frequency, bound);
      };
    if (StableStep own = plies_[k]->renew_stable_step(contact); own.step < stable_.step) stable_ = std::move(own);
  }
  if (tools_ && tools_->longest_step() < stable_.step) stable_ = {tools_->longest_step(), "contact"};
  // with every node held nothing sets a step; a row of history is then as good as any
  if (!std::isfinite(stable_.step)) stable_.step = duration_ / scene_.output.history;
  if (longest_step_ < stable_.step) stable_ = {longest_step_, "longest step asked for"};
  // viscosity of fraction xi at the highest frequency 2/step shortens the stable step to (sqrt(1 + xi^2) - xi) of it
  const double xi = scene_.analysis.yarn_viscosity;
  viscous_time_ = xi * stable_.step;
  stable_.step *= std::sqrt(1.0 + xi * xi) - xi;
  step_ = scene_.analysis.step_factor * stable_.step;
  for (auto& ply : plies_) ply->set_step(viscous_time_, step_);
  if (smallest_step_ == 0.0 || step_ < smallest_step_) {
    smallest_step_ = step_;
    step_set_by_ = stable_.set_by;
  }
}

bool World::passes_reach() {
  bool passes = between_ && between_->passes_bound();
  for (auto& ply : plies_) passes = ply->passes_reach() || passes;  // each notes its strains
  return passes;
}

void World::compute_forces() {
  if (tools_) tools_->advance(time());
  for (auto& ply : plies_) ply->compute_own_forces(step_);
  if (between_) between_->add_forces();
  for (auto& ply : plies_) ply->give_on_forces();
  if (!tools_) return;
  tools_->gather(loads_);
}

void World::advance(bool last) {
  const double now = time(), step = last ? step_ : std::min(step_, duration_ - now);
  for (auto& ply : plies_) {
    ply->holds().set_displacements(now / duration_, (now + step) / duration_);
    ply->advance(step_before_, step, last);
  }
  close_balance();
  if (last) return;
  for (auto& ply : plies_) {
    State& state = ply->state();
    state.time = now + step >= duration_ ? duration_ : now + step;
    ++state.step;
  }
  step_before_ = step;
}

// Everything but the internal energy, which only output times need.
void World::close_balance() {
  EnergyFlow sum;
  const auto add = [&sum](const EnergyFlow& flow) {
    sum.kinetic += flow.kinetic;
    sum.lost += flow.lost;
    sum.put_in += flow.put_in;
  };
  for (const auto& ply : plies_) add(ply->energy_flow());
  if (tools_) add(tools_->energy_flow());
  if (between_) add(between_->energy_flow());
  balance_.kinetic = parts_ * sum.kinetic;
  balance_.damping = parts_ * sum.lost;
  balance_.external = parts_ * sum.put_in;
}

void World::look_at_stored_energy() {
  StoredEnergy sum;
  for (auto& ply : plies_) {
    const StoredEnergy energy = ply->stored_energy();
    sum.total += energy.total;
    sum.bending += energy.bending;
    sum.hourglass += energy.hourglass;
  }
  if (tools_) sum.total += tools_->stored_energy().total;
  if (between_) sum.total += between_->stored_energy().total;
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
  for (double* energy : {&balance_.internal, &balance_.kinetic, &balance_.damping, &balance_.external,
                         &balance_.bending, &balance_.hourglass, &balance_.start, &balance_.greatest})
    archive.number("an energy", *energy);
  if (tools_) tools_->archive(archive);
  for (auto& ply : plies_) {
    ply->archive(archive);
    ply->set_step(viscous_time_, step_);
  }
  if (between_) between_->archive(archive);
}

}  // namespace weaveform
