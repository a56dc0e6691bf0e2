#include "solver/analysis/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "core/error.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/ply/gravity.hpp"

namespace weaveform {
namespace {

constexpr int check_interval = 500;          // steps between looks at the stable step and at wrong states
constexpr int cells_worth_a_thread = 20000;  // below, a second thread costs more than it brings (./dev bench)

int choose_threads(int wanted, int cells) {
  if (wanted > 0) return wanted;
  const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return std::clamp(cells / cells_worth_a_thread, 1, machine);
}

// With every node held nothing sets a step; a row of history is then as good as any.
double finite_step(double step, double duration, const OutputSpec& output) {
  return std::isfinite(step) ? step : duration / output.history;
}

}  // namespace

Analysis::Analysis(const Resolved& model, const SymmetricPart* part, std::filesystem::path directory,
                   const SolveOptions& options)
    : model_(model),
      whole_(model.mesh),
      part_(part),
      mesh_(part != nullptr ? part->mesh : whole_),
      parts_(mesh_.symmetry.parts()),
      scene_(model.scene),
      card_(model.card),
      directory_(std::move(directory)),
      options_(options),
      team_(choose_threads(options.threads, mesh_.cells.size())),
      yarn_laws_(yarn_laws(card_, scene_.model)),
      packed_(pack_mesh(mesh_)),
      ties_(mesh_.tie.empty() || (scene_.frame && scene_.frame->rigid) ? nullptr
                                                                       : std::make_unique<Ties>(mesh_, packed_)),
      mirrors_(part != nullptr ? std::make_unique<MirrorPlanes>(mesh_, packed_) : nullptr),
      state_(initial_state(packed_, mesh_)),
      grips_(make_grips(scene_, mesh_, packed_)),
      forces_(packed_, card_, yarn_laws_, scene_.model, state_, team_),
      critical_step_(mesh_, card_, yarn_laws_, scene_.model, held_nodes(grips_, mesh_, packed_)),
      internal_energy_(mesh_, card_, yarn_laws_, scene_.model),
      loading_(choose_loading(scene_, card_, model.extent())),
      duration_(loading_.duration),
      motion_(packed_, loading_.damping, team_),
      plane_(blank_plane(whole_)),
      recorder_(grips_, make_probes(scene_, whole_, model.extent()[0]), duration_, scene_.output.history),
      row_schedule_(duration_, scene_.output.history),
      frame_schedule_(duration_, scene_.output.frames),
      checkpoint_file_(options.checkpoint_file.empty() && !directory_.empty() ? directory_ / file_name::checkpoint
                                                                              : options.checkpoint_file),
      clock_(scene_.output.checkpoint_minutes),
      reach_(scene_.analysis.step_bound == "stiffest"),
      yarn_limits_(yarn_limits(card_, scene_.model)),
      displacement_(grips_.size(), 0.0),
      displacement_next_(grips_.size(), 0.0),
      grip_force_(grips_.size(), 0.0),
      grip_force_before_(grips_.size(), 0.0),
      grip_displacement_before_(grips_.size(), 0.0),
      started_(std::chrono::steady_clock::now()) {
  if (scene_.frame && !scene_.frame->rigid)
    terms_.push_back(std::make_unique<FrameMembers>(*scene_.frame, mesh_, packed_));
  if (scene_.frame)
    recorder_.evaluate_frame({scene_.frame->length, scene_.blank.size[0]}, static_cast<int>(grips_.size()) - 1);
  find_grip_images();
  add_terms();
}

// Grips are node sets of their names; a grip at rest that is mirrored onto itself feels no force across the plane.
void Analysis::find_grip_images() {
  const auto set_of = [&](const Grip& grip) {
    return std::find_if(mesh_.sets.begin(), mesh_.sets.end(), [&](const NodeSet& s) { return s.name == grip.name; }) -
           mesh_.sets.begin();
  };
  for (std::size_t k = 0; k < mesh_.symmetry.plane.size(); ++k) {
    std::vector<int>& image = grip_image_.emplace_back();
    for (auto& grip : grips_) {
      const std::string& name = mesh_.sets[mesh_.symmetry.set_image[k][set_of(grip)]].name;
      const auto found = std::find_if(grips_.begin(), grips_.end(), [&](const Grip& g) { return g.name == name; });
      image.push_back(static_cast<int>(found - grips_.begin()));
      if (found->name != grip.name || grip.travel != 0.0) continue;
      const auto turned = mirrored_vector(grip.direction, mesh_.symmetry.plane[k]);
      for (int c = 0; c < 3; ++c) grip.direction[c] = 0.5 * (grip.direction[c] + turned[c]);
    }
  }
}

void Analysis::add_terms() {
  if (Vec3 gravity = scene_.analysis.gravity; gravity != Vec3{0.0, 0.0, 0.0}) {
    for (double& component : gravity) component /= scene_.analysis.mass_scale;  // weight stays that of the real mass
    terms_.push_back(std::make_unique<Gravity>(packed_, state_, gravity));
  }
  const Flexure flexure = choose_flexure(card_, scene_.model);
  // a shear frame's members turn, so that yarns are not clamped in them
  const auto clamped = scene_.frame ? std::vector<char>(mesh_.node_count(), 0) : held_nodes(grips_, mesh_, packed_);
  if (flexure.bends_yarns || flexure.rotation_free) {
    auto bending = std::make_unique<LatticeBending>(mesh_, packed_, flexure, clamped, state_, team_,
                                                    scene_.analysis.bending_every);
    bending_ = bending.get();
    terms_.push_back(std::move(bending));
  }
  const auto stiffest = critical_step_.stiffest(every_strain);
  const double fabric_step =
      finite_step(critical_step_(mesh_positions(packed_, state_), stiffest).step, duration_, scene_.output);
  if (flexure.has_shell) {
    auto shell = std::make_unique<Shell>(mesh_, packed_, card_, flexure, clamped, state_,
                                         Shell::Setup{fabric_step, loading_.damping, team_});
    shell_ = shell.get();
    terms_.push_back(std::move(shell));
  }
  if (scene_.tools.empty()) return;
  auto contact = std::make_unique<Contact>(mesh_, scene_, model_.tools, packed_, state_, duration_, fabric_step, team_);
  contact_ = contact.get();
  terms_.push_back(std::move(contact));
  recorder_.record_tools(scene_.tools);
}

SolveResult Analysis::run() {
  if (options_.resume) {
    resume();
  } else {
    perturb();
    open_result_files({});
    renew_step();
    compute_forces();
    watch_reach();
    balance_.start = balance_.internal = stored_energy(mesh_positions(packed_, state_));
  }
  for (;;) {
    if (state_.step % check_interval == 0) {
      if (state_.step > 0) renew_step();  // a checkpoint is left before, never after, this look
      check_state();
      report_progress();
    }
    open_outputs();
    const bool last = finished();
    move(last);
    if (row_open_) close_row();
    if (history_file_) history_file_->append(recorder_.history(), recorder_.closed_rows());
    if (last || (options_.most_steps > 0 && state_.step >= options_.most_steps)) break;
    compute_forces();
    watch_reach();
    look_at_checkpoint();
  }
  recorder_.finish();
  if (!options_.quiet && options_.progress.finish) options_.progress.finish(fmt::format("{} steps", state_.step));
  return result();
}

// The next step is renewed at once when a yarn is, or comes within the next step or two to be, stretched or compressed
// further than the present one allows.
void Analysis::watch_reach() {
  if (reach_.passed_by(forces_.strains())) renew_step();
}

void Analysis::renew_step() {
  reach_.renew();
  yarn_modulus_ = critical_step_.stiffest(reach_.allowed());
  const auto position = mesh_positions(packed_, state_);
  stable_ = critical_step_(position, yarn_modulus_);
  if (!terms_.empty()) {
    const double fabric_frequency = 2.0 / finite_step(stable_.step, duration_, scene_.output);
    std::vector<double> further(mesh_.node_count(), 0.0);
    for (const auto& term : terms_) term->add_stiffness_bound(position, fabric_frequency, further);
    stable_ = critical_step_(position, yarn_modulus_, further);
    for (const auto& term : terms_)
      if (term->longest_step() < stable_.step) stable_ = {term->longest_step(), term->name()};
  }
  stable_.step = finite_step(stable_.step, duration_, scene_.output);
  // viscosity of fraction xi at the highest frequency 2/step shortens the stable step to (sqrt(1 + xi^2) - xi) of it
  const double xi = scene_.analysis.yarn_viscosity;
  set_viscous_time(xi * stable_.step);
  stable_.step *= std::sqrt(1.0 + xi * xi) - xi;
  step_ = scene_.analysis.step_factor * stable_.step;
  forces_.set_look_ahead(steps_ahead * step_);
  if (smallest_step_ == 0.0 || step_ < smallest_step_) {
    smallest_step_ = step_;
    step_set_by_ = stable_.set_by;
  }
  if (scene_.analysis.step_check && scene_.analysis.step_factor > 1.0)
    fail(fmt::format(
        "step {:.4g} s is above the stable step {:.4g} s set by the {}; set analysis.step_factor to 1 or less "
        "(now {}), or analysis.step_check = false to see what happens",
        step_, stable_.step, stable_.set_by, scene_.analysis.step_factor));
}

void Analysis::compute_forces() {
  forces_.compute(state_);
  for (const auto& term : terms_) term->add_forces(state_, step_);
  if (mirrors_) mirrors_->give_forces(state_);
  if (ties_) ties_->give_forces(state_);
  if (!mirrors_) return;
  if (ties_) mirrors_->give_forces(state_);
  mirrors_->hold(state_);
}

void Analysis::follow() {
  if (mirrors_) mirrors_->follow(state_);
  if (ties_) ties_->follow(state_);
  if (mirrors_ && ties_) mirrors_->follow(state_);
}

double Analysis::stored_energy(const std::vector<Vec3>& position) {
  double energy = internal_energy_(position, forces_.cell_work());
  for (const auto& term : terms_) energy += term->stored_energy();
  return parts_ * energy;
}

// Everything but the internal energy, which only output times need.
void Analysis::close_balance(double kinetic) {
  balance_.kinetic = kinetic;
  balance_.external = grip_work_;
  balance_.damping = damping_work_;
  for (const auto& term : terms_) {
    balance_.kinetic += term->kinetic_energy();
    balance_.external += term->external_work();
    balance_.damping += term->dissipated();
  }
  for (double* energy : {&balance_.kinetic, &balance_.external, &balance_.damping}) *energy *= parts_;
}

void Analysis::set_viscous_time(double beta) {
  viscous_time_ = beta;
  forces_.set_viscosity({beta * yarn_modulus_[0], beta * yarn_modulus_[1]});
}

void Analysis::move(bool last) {
  const double step = last ? step_ : std::min(step_, duration_ - state_.time);
  for (std::size_t g = 0; g < grips_.size(); ++g)
    displacement_next_[g] = grips_[g].travel * smooth_step((state_.time + step) / duration_);
  // the last step only tells the velocities and reactions at the end; its motion is taken back
  const Components end_position = last ? state_.position : Components{};
  const auto& outcome = motion_.advance(state_, grips_, displacement_, displacement_next_, step_before_, step);
  follow();
  if (last) state_.position = end_position;

  for (std::size_t g = 0; g < grips_.size(); ++g) {
    grip_force_[g] = outcome.grip_force[g];
    grip_work_ += 0.5 * (grip_force_before_[g] + grip_force_[g]) * (displacement_[g] - grip_displacement_before_[g]);
    grip_displacement_before_[g] = displacement_[g];
    grip_force_before_[g] = grip_force_[g];
  }
  const double damping_power = 2.0 * loading_.damping * outcome.kinetic + forces_.viscous_power();
  damping_work_ += 0.5 * (damping_power_before_ + damping_power) * step_before_;
  damping_power_before_ = damping_power;
  close_balance(outcome.kinetic);
  recorder_.add_forces(state_.time, outcome.kick, whole_grip_forces(), tool_readings());
  if (last) return;
  state_.time = state_.time + step >= duration_ ? duration_ : state_.time + step;
  ++state_.step;
  step_before_ = step;
}

// Looked at every so often and before anything is written: no output holds what is not a number, or a torn yarn.
void Analysis::check_state() {
  if (checked_step_ == state_.step) return;
  checked_step_ = state_.step;
  check_positions();
  check_yarns();
}

void Analysis::check_positions() const {
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const int p = packed_.packed_of_mesh[n];
    if (!std::isfinite(state_.position[0][p] + state_.position[1][p] + state_.position[2][p]))
      fail(fmt::format("the position of node {} is not a number; {}", mesh_.shown_node(n), what_to_do()));
  }
}

void Analysis::check_yarns() const {
  for (int e = 0; e < mesh_.yarn_count(); ++e) {
    double square = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double d = state_.position[c][packed_.packed_of_mesh[mesh_.yarns.node[e][1]]] -
                       state_.position[c][packed_.packed_of_mesh[mesh_.yarns.node[e][0]]];
      square += d * d;
    }
    const double rest = mesh_.yarns.rest_length[e] + mesh_.yarns.jaw[e];
    const double strain = std::log((std::sqrt(square) + mesh_.yarns.jaw[e]) / rest);
    const bool bears = mesh_.yarns.softening[e] > 0.0;
    const double tearing = yarn_limits_.tearing[mesh_.yarns.family[e] == Family::warp ? 0 : 1];
    // a perturbed start may stretch yarns by its own size
    const double start = std::log1p(2.0 * std::numbers::sqrt2 * scene_.analysis.perturbation / rest);
    if (strain <= (bears ? tearing : torn_strain) + start) continue;
    if (strain > torn_strain + start)
      fail(
          fmt::format("{} is stretched to a true strain of {:.3g}: the scene tears the fabric, or the analysis is "
                      "unstable; {}",
                      yarn_place(mesh_, e), strain, what_to_do()));
    fail(
        fmt::format("{} is torn: its true strain is {:.3g}, and it bears what the card's yarns tear at ({:.3g}); pull "
                    "the fabric less{}, or give the card its measured tearing_strain",
                    yarn_place(mesh_, e), strain, tearing, is_hasty() ? ", or " + what_to_do() : ""));
  }
}

// A motion far faster than what the program would choose breaks a fabric by its inertia, whatever the step.
std::string Analysis::what_to_do() const {
  if (is_hasty())
    return fmt::format("load it more slowly: the duration is {:.3g} s, and {:.3g} s would be chosen for this scene",
                       duration_, automatic_duration(scene_, card_, model_.extent()));
  return fmt::format("lower analysis.step_factor (now {})", scene_.analysis.step_factor);
}

bool Analysis::is_hasty() const {
  return scene_.analysis.step_factor <= 1.0 &&
         duration_ < hasty_share * automatic_duration(scene_, card_, model_.extent());
}

void Analysis::perturb() {
  const double size = scene_.analysis.perturbation;
  if (size <= 0.0) return;
  std::vector<char> gripped(packed_.nodes, 0);
  for (const auto& grip : grips_)
    for (const int n : grip.node) gripped[n] = 1;
  // in the plane of the blank, evenly spread over [-size, size] in both directions; the generator's own bits, so that
  // every standard library gives the same start
  std::mt19937_64 generator(static_cast<std::uint64_t>(scene_.analysis.perturbation_seed));
  const auto draw = [&] { return size * (2.0 * static_cast<double>(generator() >> 11) * 0x1.0p-53 - 1.0); };
  for (const int n : packed_.packed_of_mesh) {
    const double dx = draw(), dy = draw();
    if (gripped[n] != 0) continue;
    state_.position[0][n] += dx;
    state_.position[1][n] += dy;
  }
  if (ties_) ties_->follow(state_);
}

void Analysis::fail(const std::string& what) const {
  if (!directory_.empty()) write_history(recorder_.history(), directory_ / file_name::history);
  throw PhysicsError(fmt::format("at t = {:.4g} s, step {}: {}", state_.time, state_.step, what));
}

}  // namespace weaveform
