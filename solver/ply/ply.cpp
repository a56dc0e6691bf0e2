#include "solver/ply/ply.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "solver/bending/flexure.hpp"
#include "solver/bending/lattice_bending.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/ply/gravity.hpp"

namespace weaveform {

Ply::Ply(const PlySetup& setup)
    : whole_(setup.whole),
      part_(setup.part),
      mesh_(part_ != nullptr ? part_->mesh : whole_),
      scene_(setup.scene),
      card_(setup.card),
      duration_(setup.duration),
      damping_(setup.damping),
      yarn_laws_(yarn_laws(card_, scene_.model)),
      packed_(pack_mesh(mesh_)),
      ties_(mesh_.tie.empty() || (scene_.frame && scene_.frame->rigid) ? nullptr
                                                                       : std::make_unique<Ties>(mesh_, packed_)),
      mirrors_(part_ != nullptr ? std::make_unique<MirrorPlanes>(mesh_, packed_) : nullptr),
      state_(initial_state(packed_, mesh_)),
      holds_(scene_, mesh_, packed_),
      forces_(packed_, card_, yarn_laws_, scene_.model, state_, setup.team, scene_.analysis.precision),
      critical_step_(mesh_, card_, yarn_laws_, scene_.model, held_nodes(holds_.grips(), mesh_, packed_)),
      internal_energy_(mesh_, card_, yarn_laws_, scene_.model),
      motion_(packed_, forces_.bands(), waiting_nodes(mesh_, packed_, holds_.grips()), damping_, setup.team),
      reach_(scene_.analysis.step_bound == StepBound::stiffest),
      yarn_limits_(yarn_limits(card_, scene_.model)) {
  const auto stiffest = critical_step_.stiffest(every_strain);
  fabric_step_ = critical_step_(positions(), stiffest).step;
  // every node held: nothing sets a step, and what touches the ply meets springs as of a free one
  if (!std::isfinite(fabric_step_)) {
    const std::vector<char> none(mesh_.node_count(), 0);
    fabric_step_ = CriticalStep(mesh_, card_, yarn_laws_, scene_.model, none)(positions(), stiffest).step;
  }
  add_own_actors(setup);
}

void Ply::add_own_actors(const PlySetup& setup) {
  if (scene_.frame && !scene_.frame->rigid) add(std::make_unique<FrameMembers>(*scene_.frame, mesh_, packed_));
  if (Vec3 gravity = scene_.analysis.gravity; gravity != Vec3{0.0, 0.0, 0.0}) {
    for (double& component : gravity) component /= scene_.analysis.mass_scale;  // weight stays that of the real mass
    add(std::make_unique<Gravity>(packed_, state_, gravity));
  }
  require_coupling(card_, scene_.model);
  if (card_.shear.tension_coupling > 0.0) {
    auto coupling = std::make_unique<TensionShear>(mesh_, packed_, card_, yarn_laws_);
    coupling_ = coupling.get();
    add(std::move(coupling));
  }
  const Flexure flexure = choose_flexure(card_, scene_);
  // a shear frame's members turn, so that yarns are not clamped in them
  const auto clamped =
      scene_.frame ? std::vector<char>(mesh_.node_count(), 0) : held_nodes(holds_.grips(), mesh_, packed_);
  if (flexure.bends_yarns || flexure.rotation_free)
    add(std::make_unique<LatticeBending>(mesh_, packed_, flexure, clamped, state_, setup.team,
                                         scene_.analysis.bending_every));
  if (!flexure.has_shell) return;
  auto shell = std::make_unique<Shell>(mesh_, packed_, card_, flexure, clamped, state_,
                                       Shell::Setup{fabric_step_, damping_, setup.team});
  shell_ = shell.get();
  add(std::move(shell));
}

void Ply::add(std::unique_ptr<Actor> actor) {
  actors_.push_back(std::move(actor));
  set_flat(false);
}

bool Ply::lies_flat() const {
  const auto zero = [](const Doubles& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double number) { return number == 0.0; });
  };
  const auto& grips = holds_.grips();
  return zero(state_.position[2]) && zero(state_.velocity[2]) &&
         std::all_of(grips.begin(), grips.end(), [](const Grip& grip) { return grip.direction[2] == 0.0; });
}

void Ply::seek_plane() {
  set_flat(!stays_in_space_ && actors_.empty() && forces_.has_flat_loops() && lies_flat());
}

void Ply::leave_plane() {
  stays_in_space_ = true;
  set_flat(false);
}

void Ply::set_flat(bool flat) {
  flat_ = flat;
  forces_.set_flat(flat);
  motion_.set_flat(flat);
}

bool Ply::passes_reach() {
  FamilyStrains strains = forces_.strains();
  for (std::size_t f = 0; coupling_ != nullptr && f < strains.size(); ++f) strains[f].hold(coupling_->strains()[f]);
  return reach_.passed_by(strains, forces_.sharpest());
}

double Ply::mass() const {
  double mass = 0.0;
  for (const int n : packed_.packed_of_mesh) mass += packed_.mass[n];
  return mass;
}

void Ply::perturb(double size, std::uint64_t seed) {
  std::vector<char> gripped(packed_.nodes, 0);
  for (const auto& grip : holds_.grips())
    for (const int n : grip.node) gripped[n] = 1;
  // evenly spread over [-size, size] in both directions; the generator's own bits, so that every standard library gives
  // the same start
  std::mt19937_64 generator(seed);
  const auto draw = [&] { return size * (2.0 * static_cast<double>(generator() >> 11) * 0x1.0p-53 - 1.0); };
  for (const int n : packed_.packed_of_mesh) {
    const double dx = draw(), dy = draw();
    if (gripped[n] != 0) continue;
    state_.position[0][n] += dx;
    state_.position[1][n] += dy;
  }
  if (ties_) ties_->follow(state_);
}

StableStep Ply::renew_stable_step() {
  reach_.renew();
  yarn_modulus_ = critical_step_.stiffest(reach_.allowed());
  const auto position = positions();
  const NodeStiffness stiffness = critical_step_.at_nodes(position, yarn_modulus_);
  StableStep stable = critical_step_.step(stiffness);
  if (!actors_.empty()) {
    const double fabric_frequency = 2.0 / (std::isfinite(stable.step) ? stable.step : fabric_step_);
    std::vector<double> further(mesh_.node_count(), 0.0);
    for (const auto& actor : actors_) actor->add_stiffness_bound(position, fabric_frequency, further);
    stable = critical_step_.step(stiffness, further);
    for (const auto& actor : actors_)
      if (actor->longest_step() < stable.step) stable = {actor->longest_step(), actor->name()};
  }
  return stable;
}

void Ply::set_step(double viscous_time, double step) {
  std::array<double, 2> lesser{};
  for (int f = 0; f < 2; ++f) {
    const double viscosity = viscous_time * yarn_modulus_[f];
    lesser[f] = std::min(viscosity_[f], viscosity);
    viscosity_[f] = viscosity;
  }
  forces_.set_viscosity(lesser);
  forces_.set_look_ahead(steps_ahead * step);
}

void Ply::compute_own_forces(double step) {
  forces_.compute(state_);
  for (const auto& actor : actors_) actor->add_forces(state_, step);
}

void Ply::give_on_forces() {
  if (mirrors_) mirrors_->give_forces(state_);
  if (ties_) ties_->give_forces(state_);
  if (!mirrors_) return;
  if (ties_) mirrors_->give_forces(state_);
  mirrors_->hold(state_);
}

void Ply::follow() {
  if (mirrors_) mirrors_->follow(state_);
  if (ties_) ties_->follow(state_);
  if (mirrors_ && ties_) mirrors_->follow(state_);
}

void Ply::advance(double step_before, double step, bool last) {
  const Components end_position = last ? state_.position : Components{};
  const auto& outcome =
      motion_.advance(state_, holds_.grips(), holds_.displacement(), holds_.displacement_after(), step_before, step);
  follow();
  if (last) state_.position = end_position;
  note_motion(outcome, step_before);
}

void Ply::compute_forces_and_advance(double step_before, double step) {
  const BandMove move = motion_.begin(state_, holds_.grips(), step_before, step);
  forces_.compute_and_move(state_, move);
  give_on_forces();
  const auto& outcome =
      motion_.finish(state_, move, holds_.grips(), holds_.displacement(), holds_.displacement_after());
  follow();
  note_motion(outcome, step_before);
}

void Ply::note_motion(const Motion::Outcome& outcome, double step_before) {
  forces_.set_viscosity(viscosity_);
  holds_.note_forces(outcome.grip_force);
  const double damping_power = 2.0 * damping_ * outcome.kinetic + forces_.viscous_power();
  damping_work_ += 0.5 * (damping_power_before_ + damping_power) * step_before;
  damping_power_before_ = damping_power;
  kinetic_ = outcome.kinetic;
  kick_ = outcome.kick;
}

StoredEnergy Ply::stored_energy() {
  StoredEnergy sum;
  sum.total = internal_energy_(positions(), forces_.cell_work());
  for (const auto& actor : actors_) {
    const StoredEnergy energy = actor->stored_energy();
    sum.total += energy.total;
    sum.bending += energy.bending;
    sum.hourglass += energy.hourglass;
  }
  return sum;
}

EnergyFlow Ply::energy_flow() const {
  EnergyFlow sum = {.kinetic = kinetic_, .lost = damping_work_, .put_in = holds_.work()};
  for (const auto& actor : actors_) sum.add(actor->energy_flow());
  return sum;
}

std::vector<Vec3> Ply::whole_positions() const {
  const auto position = positions();
  return part_ != nullptr ? unfold(*part_, whole_, position) : position;
}

void Ply::archive(Archive& archive) {
  archive_state(archive, state_, duration_);
  holds_.archive(archive);
  forces_.archive(archive);
  reach_.archive(archive);
  internal_energy_.archive(archive);
  archive.number("a damping work", damping_work_);
  archive.number("a damping power", damping_power_before_);
  for (const auto& actor : actors_) actor->archive(archive);
  yarn_modulus_ = critical_step_.stiffest(reach_.allowed());
}

}  // namespace weaveform
