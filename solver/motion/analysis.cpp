#include "solver/motion/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <thread>

#include "mesher/base/error.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/motion/gravity.hpp"
#include "solver/motion/interrupt.hpp"

namespace weaveform {
namespace {

constexpr int check_interval = 500;          // steps between looks at the stable step and at wrong states
constexpr double torn_strain = 0.5;          // a yarn never bears this; the stable step is bounded up to here
constexpr int cells_worth_a_thread = 20000;  // below, a second thread costs more than it brings (./dev bench)
constexpr double start_fraction = 0.1;       // of the duration; the energy balance is judged after it
constexpr double rounding_energy = 1e-15;    // mJ; a fabric on which nothing acts has less, and no balance to judge
constexpr double start_travel = 0.1;  // of the travel; kinetic/internal is judged after it (before, both are near zero)

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

Analysis::Analysis(const Mesh& whole, const SymmetricPart* part, const Scene& scene, const Card& card,
                   std::filesystem::path directory, const SolveOptions& options)
    : whole_(whole),
      part_(part),
      mesh_(part != nullptr ? part->mesh : whole),
      parts_(mesh_.symmetry.parts()),
      scene_(scene),
      card_(card),
      directory_(std::move(directory)),
      options_(options),
      threads_(choose_threads(options.threads, mesh_.cells.size())),
      yarn_laws_(yarn_laws(card, scene.model)),
      packed_(pack_mesh(mesh_)),
      ties_(mesh_.tie.empty() || (scene.frame && scene.frame->rigid) ? nullptr
                                                                     : std::make_unique<Ties>(mesh_, packed_)),
      mirrors_(part != nullptr ? std::make_unique<MirrorPlanes>(mesh_, packed_) : nullptr),
      state_(initial_state(packed_, mesh_)),
      grips_(make_grips(scene, mesh_, packed_)),
      forces_(packed_, card, yarn_laws_, scene.model, state_, threads_),
      critical_step_(mesh_, card, yarn_laws_, scene.model, held_nodes(grips_, mesh_, packed_)),
      internal_energy_(mesh_, card, yarn_laws_, scene.model),
      loading_(choose_loading(scene, card)),
      duration_(loading_.duration),
      motion_(packed_, loading_.damping, threads_),
      recorder_(grips_, make_probes(scene, whole_), duration_, scene.output.history),
      row_schedule_(duration_, scene.output.history),
      frame_schedule_(duration_, scene.output.frames),
      progress_("solve", options.quiet),
      displacement_(grips_.size(), 0.0),
      displacement_next_(grips_.size(), 0.0),
      grip_force_(grips_.size(), 0.0),
      grip_force_before_(grips_.size(), 0.0),
      grip_displacement_before_(grips_.size(), 0.0),
      started_(std::chrono::steady_clock::now()) {
  if (scene.frame && !scene.frame->rigid)
    terms_.push_back(std::make_unique<FrameMembers>(*scene.frame, mesh_, packed_));
  if (scene.frame)
    recorder_.evaluate_frame({scene.frame->length, scene.blank.size[0]}, static_cast<int>(grips_.size()) - 1);
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

// A grip of the whole is held by its own nodes and by those of its images, each over its part of the fabric.
const std::vector<double>& Analysis::whole_grip_forces() {
  whole_grip_force_ = grip_force_;
  for (const auto& image : grip_image_) {
    one_side_ = whole_grip_force_;
    for (std::size_t g = 0; g < one_side_.size(); ++g) whole_grip_force_[g] += one_side_[image[g]];
  }
  return whole_grip_force_;
}

void Analysis::add_terms() {
  if (scene_.analysis.gravity != Vec3{0.0, 0.0, 0.0})
    terms_.push_back(std::make_unique<Gravity>(packed_, state_, scene_.analysis.gravity));
  const Flexure flexure = choose_flexure(card_, scene_.model);
  // a shear frame's members turn, so that yarns are not clamped in them
  const auto clamped = scene_.frame ? std::vector<char>(mesh_.node_count(), 0) : held_nodes(grips_, mesh_, packed_);
  if (flexure.bends_yarns || flexure.rotation_free) {
    auto bending = std::make_unique<LatticeBending>(mesh_, packed_, flexure, clamped, state_, threads_);
    bending_ = bending.get();
    terms_.push_back(std::move(bending));
  }
  const double fabric_step =
      finite_step(critical_step_(mesh_positions(packed_, state_)).step, duration_, scene_.output);
  if (flexure.has_shell) {
    auto shell = std::make_unique<Shell>(mesh_, packed_, card_, flexure, clamped, state_,
                                         Shell::Setup{fabric_step, loading_.damping, threads_});
    shell_ = shell.get();
    terms_.push_back(std::move(shell));
  }
  if (scene_.tools.empty()) return;
  auto contact = std::make_unique<Contact>(mesh_, scene_, packed_, state_, duration_, fabric_step, threads_);
  contact_ = contact.get();
  terms_.push_back(std::move(contact));
  recorder_.record_tools(scene_.tools);
}

SolveResult Analysis::run() {
  const InterruptWatch interrupt;
  if (options_.resume)
    resume();
  else
    perturb();
  if (!directory_.empty())
    frames_ =
        std::make_unique<FrameWriter>(directory_, whole_, options_.resume ? frame_schedule_.index() : 0, tool_names());
  if (!options_.resume) renew_step();
  if (options_.resume)
    recompute_fabric_forces();
  else
    compute_forces();
  if (!options_.resume) balance_.start = balance_.internal = stored_energy(mesh_positions(packed_, state_));
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
    if (last) break;
    compute_forces();
    if (InterruptWatch::requested()) leave_checkpoint();
  }
  recorder_.finish();
  progress_.finish(fmt::format("{} steps", state_.step));
  return result();
}

void Analysis::renew_step() {
  const auto position = mesh_positions(packed_, state_);
  std::vector<double> further(terms_.empty() ? 0 : mesh_.node_count(), 0.0);
  for (const auto& term : terms_) term->add_stiffness_bound(position, further);
  stable_ = critical_step_(position, further);
  stable_.step = finite_step(stable_.step, duration_, scene_.output);
  // viscosity of fraction xi at the highest frequency 2/step shortens the stable step to (sqrt(1 + xi^2) - xi) of it
  const double xi = scene_.analysis.yarn_viscosity;
  set_viscous_time(xi * stable_.step);
  stable_.step *= std::sqrt(1.0 + xi * xi) - xi;
  step_ = scene_.analysis.step_factor * stable_.step;
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

// After a checkpoint: the terms have moved on to this time already, and the whole force is that of the checkpoint.
void Analysis::recompute_fabric_forces() {
  const Components whole = state_.force;
  forces_.compute(state_);
  state_.force = whole;
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
  const auto& stiffest = critical_step_.stiffest();
  forces_.set_viscosity({beta * stiffest[0], beta * stiffest[1]});
}

ContactState Analysis::whole_contact_state() const {
  ContactState state = contact_->contact_state(state_);
  if (part_ == nullptr) return state;
  const auto share = node_share(mesh_.symmetry, mesh_.node_count());
  std::vector<int> source;
  std::vector<double> factor;
  for (const auto& image : part_->image) {
    source.push_back(image.node);
    factor.push_back(1.0 / share[image.node]);
  }
  return unfolded(state, source, factor);
}

void Analysis::open_outputs() {
  const double time = state_.time;
  const bool row_due = row_schedule_.due(time), frame_due = frame_schedule_.due(time);
  for (std::size_t g = 0; g < grips_.size(); ++g) displacement_[g] = grips_[g].travel * smooth_step(time / duration_);
  if (!row_due && !frame_due) return;
  const auto position = mesh_positions(packed_, state_);
  fields_ =
      compute_fields(whole_, card_, scene_.model, time, part_ != nullptr ? unfold(*part_, whole_, position) : position);
  if (frame_due) {
    if (contact_ != nullptr) fields_.contact = whole_contact_state();
    if (frames_) frames_->write(fields_);
    frame_schedule_.advance(time);
  }
  if (row_due) {
    balance_.internal = stored_energy(position);
    balance_.bending = parts_ * ((bending_ != nullptr ? bending_->stored_energy() : 0.0) +
                                 (shell_ != nullptr ? shell_->stored_energy() : 0.0));
    balance_.hourglass = shell_ != nullptr ? parts_ * shell_->hourglass_energy() : 0.0;
    folded_ = std::max(folded_, static_cast<int>(std::count(fields_.folded.begin(), fields_.folded.end(), true)));
    row_schedule_.advance(time);
    row_open_ = true;
  }
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

// Part of the travel made, the least of all grips and tools.
double Analysis::travelled() const {
  const double part = fields_.time / duration_;
  double least = smooth_step(part);
  for (const auto& tool : scene_.tools)
    if (!tool.speed.empty()) least = std::min(least, travel_part(tool.speed, part));
  return least;
}

std::vector<std::string> Analysis::tool_names() const {
  std::vector<std::string> names;
  for (const auto& tool : scene_.tools) names.push_back(tool.name);
  return names;
}

const std::vector<ToolReading>& Analysis::tool_readings() const {
  static const std::vector<ToolReading> none;
  return contact_ != nullptr ? contact_->readings() : none;
}

void Analysis::close_row() {
  row_open_ = false;
  balance_.note_greatest();
  const double error = balance_.error();
  // the row's forces follow when their window closes; this step's open the next window when it is later than that
  recorder_.add_row(fields_.time, displacement_, fields_, balance_, tool_readings());
  if (fields_.time > start_fraction * duration_) {
    const bool judged = std::max({balance_.internal, balance_.kinetic, balance_.damping}) > rounding_energy;
    if (judged) worst_error_ = std::max(worst_error_, error);
    const bool under_way = travelled() > start_travel;
    if (under_way && balance_.internal > 0.0)
      worst_ratio_ = std::max(worst_ratio_, balance_.kinetic / balance_.internal);
    if (judged && !(error <= scene_.analysis.energy_limit))
      fail(fmt::format(
          "the energy balance is off by {:.3g} % of the greatest energy (limit {:.3g} %): internal {:.4g}, kinetic "
          "{:.4g}, damping {:.4g}, external {:.4g} mJ; lower analysis.step_factor (now {})",
          100.0 * error, 100.0 * scene_.analysis.energy_limit, balance_.internal, balance_.kinetic, balance_.damping,
          balance_.external, scene_.analysis.step_factor));
  }
}

void Analysis::check_state() {
  for (int n = 0; n < mesh_.node_count(); ++n) {
    const int p = packed_.packed_of_mesh[n];
    if (!std::isfinite(state_.position[0][p] + state_.position[1][p] + state_.position[2][p]))
      fail(fmt::format("the position of node {} is not a number; lower analysis.step_factor (now {})",
                       mesh_.shown_node(n), scene_.analysis.step_factor));
  }
  for (int e = 0; e < mesh_.yarn_count(); ++e) {
    double square = 0.0;
    for (int c = 0; c < 3; ++c) {
      const double d = state_.position[c][packed_.packed_of_mesh[mesh_.yarns.node[e][1]]] -
                       state_.position[c][packed_.packed_of_mesh[mesh_.yarns.node[e][0]]];
      square += d * d;
    }
    const double rest = mesh_.yarns.rest_length[e] + mesh_.yarns.jaw[e];
    const double strain = std::log((std::sqrt(square) + mesh_.yarns.jaw[e]) / rest);
    // a perturbed start may stretch yarns by its own size
    if (strain > torn_strain + std::log1p(2.0 * std::numbers::sqrt2 * scene_.analysis.perturbation / rest))
      fail(fmt::format(
          "the {} yarn element between nodes {} and {} is stretched to a true strain of {:.3g}: the analysis is "
          "unstable (lower analysis.step_factor, now {}) or the scene tears the fabric",
          mesh_.yarns.family[e] == Family::warp ? "warp" : "weft", mesh_.shown_node(mesh_.yarns.node[e][0]),
          mesh_.shown_node(mesh_.yarns.node[e][1]), strain, scene_.analysis.step_factor));
  }
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

std::string Analysis::identity() const {
  return fmt::format(
      "{} nodes, {} yarns, {} cells, {} {} {} {} {}, duration {:.17g}, damping {:.17g}, factor {:.17g}, rows {}, "
      "frames {}",
      mesh_.node_count(), mesh_.yarn_count(), mesh_.cells.size(), card_.name, scene_.model.yarn, scene_.model.cell,
      scene_.model.formulation, scene_.model.thickness, duration_, loading_.damping, scene_.analysis.step_factor,
      scene_.output.history, scene_.output.frames);
}

void Analysis::leave_checkpoint() {
  if (directory_.empty()) throw Interrupted("interrupted");
  std::vector<std::vector<double>> term_memory;
  for (const auto& term : terms_) term_memory.push_back(term->memory());
  const Checkpoint checkpoint{
      .state = state_,
      .step_before = step_before_,
      .step = step_,
      .smallest_step = smallest_step_,
      .viscous_time = viscous_time_,
      .power_before = damping_power_before_,
      .force_before = grip_force_before_,
      .displacement_before = grip_displacement_before_,
      .wall_s = wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count(),
      .next_row = row_schedule_.index(),
      .next_frame = frame_schedule_.index(),
      .balance = balance_,
      .grip_work = grip_work_,
      .damping_work = damping_work_,
      .worst_error = worst_error_,
      .worst_ratio = worst_ratio_,
      .folded = folded_,
      .path = internal_energy_.path(),
      .cell_history = forces_.history(),
      .term_memory = std::move(term_memory),
      .history = recorder_.history(),
      .window = recorder_.window()};
  const auto file = directory_ / "checkpoint.bin";
  write_checkpoint(checkpoint, identity(), file);
  write_history(recorder_.history(), directory_ / "history.csv");
  throw Interrupted(fmt::format("stopped at t = {:.4g} s of {:.4g} s, step {}; go on with --resume ({})", state_.time,
                                duration_, state_.step, file.string()));
}

void Analysis::resume() {
  Checkpoint checkpoint = read_checkpoint(identity(), directory_ / "checkpoint.bin");
  state_ = std::move(checkpoint.state);
  step_before_ = checkpoint.step_before;
  step_ = checkpoint.step;
  smallest_step_ = checkpoint.smallest_step;
  set_viscous_time(checkpoint.viscous_time);
  damping_power_before_ = checkpoint.power_before;
  grip_force_before_ = std::move(checkpoint.force_before);
  grip_displacement_before_ = std::move(checkpoint.displacement_before);
  wall_before_ = checkpoint.wall_s;
  row_schedule_.set_index(checkpoint.next_row);
  frame_schedule_.set_index(checkpoint.next_frame);
  balance_ = checkpoint.balance;
  grip_work_ = checkpoint.grip_work;
  damping_work_ = checkpoint.damping_work;
  for (std::size_t k = 0; k < terms_.size() && k < checkpoint.term_memory.size(); ++k)
    terms_[k]->recall(checkpoint.term_memory[k]);
  worst_error_ = checkpoint.worst_error;
  worst_ratio_ = checkpoint.worst_ratio;
  folded_ = checkpoint.folded;
  internal_energy_.set_path(std::move(checkpoint.path));
  forces_.set_history(checkpoint.cell_history);
  recorder_.restore(std::move(checkpoint.history), std::move(checkpoint.window));
}

void Analysis::report_progress() {
  const double fraction = state_.time / duration_;
  if (!progress_.due(fraction)) return;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  const double rate = wall > 0.0 ? static_cast<double>(state_.step) * mesh_.cells.size() / wall : 0.0;
  progress_.update(fraction,
                   fmt::format("step {}  {:.1f} M cell-steps/s  kinetic/internal {:.2g}", state_.step, 1e-6 * rate,
                               balance_.internal > 0.0 ? balance_.kinetic / balance_.internal : 0.0));
}

void Analysis::fail(const std::string& what) const {
  if (!directory_.empty()) write_history(recorder_.history(), directory_ / "history.csv");
  throw PhysicsError(fmt::format("at t = {:.4g} s, step {}: {}", state_.time, state_.step, what));
}

SolveResult Analysis::result() {
  SolveResult result;
  result.history = recorder_.history();
  result.position = fields_.position;
  auto& s = result.statistics;
  s.cells = whole_.cells.size();
  s.nodes = whole_.node_count();
  s.yarns = whole_.yarn_count();
  s.symmetry = parts_ == 4 ? "quarter" : parts_ == 2 ? "half" : "none";
  s.cells_solved = mesh_.cells.size();
  s.steps = state_.step;
  s.duration_s = duration_;
  s.wall_s = wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  s.cell_steps_per_s = static_cast<double>(s.steps) * s.cells_solved / s.wall_s;
  s.step_s = smallest_step_;
  s.step_set_by = step_set_by_;
  s.damping_per_s = loading_.damping;
  s.energy_error = worst_error_;
  s.kinetic_to_internal = worst_ratio_;
  s.damping_work_mJ = balance_.damping;
  s.bending_energy_mJ = balance_.bending;
  s.hourglass_energy_mJ = balance_.hourglass;
  if (shell_ != nullptr) s.rotary_inertia_scale = shell_->inertia_scale();
  for (const double angle : fields_.shear_angle) {
    const double degrees = std::abs(angle) * 180.0 / std::numbers::pi;
    s.max_shear_angle_deg = std::max(s.max_shear_angle_deg, degrees);
    s.cells_beyond_card += degrees > card_.shear.valid_to_deg ? 1 : 0;
  }
  for (const double strain : fields_.yarn_strain) s.max_yarn_strain = std::max(s.max_yarn_strain, strain);
  s.folded_cells = folded_;
  s.folded_cells_at_end = static_cast<int>(std::count(fields_.folded.begin(), fields_.folded.end(), true));
  s.threads = threads_;
  if (contact_ != nullptr) {
    const Contact::Cost cost = contact_->cost();
    s.contact_penetration = cost.penetration;
    s.friction_work_mJ = parts_ * cost.friction_work;
    s.contact_damping_work_mJ = parts_ * cost.damping_work;
    s.contact_wall_s = cost.wall_s;
  }
  if (scene_.frame && !scene_.frame->rigid) {
    const auto& frame = *scene_.frame;
    s.added_mass_t = (frame.mass_scale - 1.0) * 4.0 * frame.density * frame.section * frame.length;
  }
  if (!directory_.empty()) {
    write_history(result.history, directory_ / "history.csv");
    write_statistics(s, directory_ / "solve.json");
    std::filesystem::remove(directory_ / "checkpoint.bin");
  }
  return result;
}

}  // namespace weaveform
