#include "solver/analysis/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {
namespace {

constexpr int check_interval = 500;         // steps between looks at the stable step and at wrong states
constexpr int cells_worth_a_thread = 1000;  // below, no second thread brings anything; above, the team's pace finds out
constexpr long clock_look = 16;  // steps between looks at the clock, which costs a hundredth of the smallest step

int choose_threads(int wanted, int cells) {
  if (wanted > 0) return wanted;
  const int machine = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return std::clamp(cells / cells_worth_a_thread, 1, machine);
}

}  // namespace

Analysis::Analysis(const Resolved& model, std::vector<SymmetricPart> parts, std::filesystem::path directory,
                   const SolveOptions& options)
    : model_(model),
      whole_(model.mesh),
      scene_(model.scene),
      parts_(std::move(parts)),
      directory_(std::move(directory)),
      options_(options),
      team_(choose_threads(options.threads, cells_solved())),
      loading_(choose_loading(model_)),
      world_(world_setup()),
      outputs_(model, world_, directory_),
      verdict_(scene_, world_.duration()),
      checkpoint_file_(options.checkpoint_file.empty() && !directory_.empty() ? directory_ / file_name::checkpoint
                                                                              : options.checkpoint_file),
      clock_(scene_.output.checkpoint_minutes),
      started_(std::chrono::steady_clock::now()) {}

int Analysis::cells_solved() const {
  if (parts_.empty()) return whole_.cells.size();
  int cells = 0;
  for (const SymmetricPart& part : parts_) cells += part.mesh.cells.size();
  return cells;
}

WorldSetup Analysis::world_setup() {
  WorldSetup setup{.plies = {}, .tools = model_.tools, .scene = scene_, .loading = loading_, .team = team_};
  for (std::size_t k = 0; k < model_.plies(); ++k) {
    const Resolved& ply = model_.of_ply(k);
    setup.plies.push_back({.whole = ply.mesh,
                           .part = parts_.empty() ? nullptr : &parts_[k],
                           .card = ply.card,
                           .scene = ply.scene,
                           .tools = &ply.tools});
  }
  for (const MeshPly& ply : whole_.ply) setup.ply_names.push_back(ply.name);
  setup.pair_law = [this](int lower, int upper) {
    const ResolvedPair& pair = model_.pair[pair_number(lower, upper)];
    return PairLaw{pair.friction, pair.shear_law, pair.compaction};
  };
  return setup;
}

SolveResult Analysis::run() {
  open();
  while (step_on()) {
    while (goes_on_plainly()) pass_on();
    renew_forces();
    look_at_checkpoint();
  }
  return close();
}

void Analysis::open() {
  if (options_.resume)
    resume();
  else
    begin();
}

bool Analysis::step_on() {
  keep_pace();
  if (world_.steps() % check_interval == 0) look_around();
  open_outputs();
  const bool last = world_.finished();
  step(last);
  close_outputs();
  return !last && !stops_here();
}

void Analysis::keep_pace() {
  if (team_.threads() > 1) pace_.next_step(outputs_.writes_beside());
}

void Analysis::renew_forces() {
  world_.compute_forces();
  if (world_.passes_reach()) renew_step();
}

// Whether the next step is one that nobody looks at: forces and motion may then be one pass.
bool Analysis::goes_on_plainly() const {
  return world_.moves_in_one_pass() && world_.is_calm() && world_.steps() % check_interval != 0 && !world_.finished() &&
         !outputs_.due(world_.time()) && !checkpoint_due() &&
         !(options_.most_steps > 0 && world_.steps() + 1 >= options_.most_steps);
}

void Analysis::pass_on() {
  keep_pace();
  const double time = world_.time();
  world_.compute_forces_and_advance();
  outputs_.record_forces(world_, time);
  outputs_.append_rows();
  if (world_.passes_reach() || world_.passed_reach()) renew_step();
}

SolveResult Analysis::close() {
  outputs_.finish();
  if (!options_.quiet && options_.progress.finish) options_.progress.finish(fmt::format("{} steps", world_.steps()));
  SolveResult result{.history = outputs_.history(), .statistics = statistics(), .position = outputs_.fields().position};
  result.statistics.finished = true;
  return result;
}

void Analysis::archive(Archive& archive) {
  world_.archive(archive);
  outputs_.archive(archive);
  verdict_.archive(archive);
  double wall_s = wall(), contact_wall_s = contact_wall();
  archive.number("a wall time", wall_s, not_negative);
  archive.number("a wall time", contact_wall_s, not_negative);
  wall_before_ += wall_s - wall();
  contact_wall_before_ += contact_wall_s - contact_wall();
}

ArchiveState Analysis::all_state() {
  return [this](Archive& keeper) { archive(keeper); };
}

void Analysis::begin() {
  outputs_.open_files();
  world_.start();
  refuse_long_step();
}

// The forces are those of the checkpoint, and everything that has a history stands behind them already.
void Analysis::resume() {
  read_checkpoint(read_text_file(checkpoint_file_), identity(), all_state(), checkpoint_file_.string());
  check_state();
  outputs_.open_files();
}

void Analysis::renew_step() {
  pace_.not_plain();
  world_.renew_step();
  refuse_long_step();
  if (const std::string found = world_.endless_run(); !found.empty()) fail(found);
}

void Analysis::refuse_long_step() const {
  if (scene_.analysis.step_check && scene_.analysis.step_factor > 1.0)
    fail(fmt::format(
        "step {:.4g} s is above the stable step {:.4g} s set by the {}; set analysis.step_factor to 1 or less "
        "(now {}), or analysis.step_check = false to see what happens",
        world_.step(), world_.stable_step().step, world_.stable_step().set_by, scene_.analysis.step_factor));
}

// A checkpoint is left before, never after, this look.
void Analysis::look_around() {
  if (world_.steps() > 0) renew_step();
  check_state();
  report_progress();
}

// Looked at every so often and before anything is written: no output holds what is not a number, or a torn yarn.
void Analysis::check_state() {
  if (checked_step_ == world_.steps()) return;
  checked_step_ = world_.steps();
  for (std::size_t k = 0; k < world_.size(); ++k)
    if (const std::string found = world_.ply(k).trouble([&] { return what_to_do(); }, is_hasty()); !found.empty())
      fail(name_before(model_, k) + found);
}

void Analysis::open_outputs() {
  if (!outputs_.due(world_.time())) return;
  pace_.not_plain();
  check_state();
  if (outputs_.look(world_)) write_statistics(statistics(), directory_ / file_name::statistics);
  if (!outputs_.row_open()) return;
  world_.look_at_stored_energy();
  verdict_.count_folded(outputs_.fields());
}

void Analysis::step(bool last) {
  const double time = world_.time();
  world_.advance(last);
  outputs_.record_forces(world_, time);
  if (!last && world_.passed_reach()) renew_step();
}

void Analysis::close_outputs() {
  if (outputs_.row_open()) {
    world_.note_greatest_energy();
    outputs_.close_row(world_);
    if (const std::string end = verdict_.judge(world_.balance(), outputs_.fields().time); !end.empty())
      fail(end + "; " + what_to_do());
  }
  outputs_.append_rows();
}

bool Analysis::stops_here() const {
  return options_.most_steps > 0 && world_.steps() >= options_.most_steps;
}

bool Analysis::stop_asked() const {
  return (options_.stop_requested && options_.stop_requested()) ||
         (options_.stop_at_step > 0 && world_.steps() >= options_.stop_at_step);
}

bool Analysis::checkpoint_due() const {
  // what follows a perturbed run, the same without, takes as long again
  const bool before_clean_run = scene_.analysis.perturbation > 0.0 && world_.finished();
  return stop_asked() || before_clean_run || (world_.steps() % clock_look == 0 && clock_.due());
}

void Analysis::look_at_checkpoint() {
  const bool stop = stop_asked();
  if (stop || checkpoint_due()) leave_checkpoint();
  if (!stop) return;
  if (checkpoint_file_.empty()) throw Interrupted("interrupted");
  throw Interrupted(fmt::format("stopped at t = {:.4g} s of {:.4g} s, step {}; go on with --resume ({})", world_.time(),
                                world_.duration(), world_.steps(), checkpoint_file_.string()));
}

void Analysis::leave_checkpoint() {
  if (checkpoint_file_.empty()) return;
  pace_.not_plain();
  const auto begin = CheckpointClock::Clock::now();
  check_state();
  if (const std::string member = unsound_member(all_state()); !member.empty())
    fail(member + " is not a number; " + what_to_do());
  outputs_.settle();
  if (clock_.count() == 0 && !directory_.empty())
    for (const char* name : {file_name::scene, file_name::mesh}) settle_on_disk(directory_ / name);
  write_text_whole(checkpoint_file_, checkpoint_bytes(identity(), all_state()), Durability::power);
  clock_.note_written(begin);
}

// Takes time, and only runs with a folder or a checkpoint need it.
const Identity& Analysis::identity() {
  if (identity_.empty()) identity_ = identity_of(model_, options_.program);
  return identity_;
}

void Analysis::report_progress() {
  const double fraction = world_.time() / world_.duration();
  if (options_.quiet || !options_.progress.is_due(fraction)) return;
  const double seconds = wall();
  const double rate = seconds > 0.0 ? static_cast<double>(world_.steps()) * cells_solved() / seconds : 0.0;
  const EnergyBalance& balance = world_.balance();
  options_.progress.update(
      fraction, fmt::format("{:.1f} M cell-steps/s  step {}  kinetic/internal {:.2g}", 1e-6 * rate, world_.steps(),
                            balance.internal > 0.0 ? balance.kinetic / balance.internal : 0.0));
}

double Analysis::wall() const {
  return wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

double Analysis::contact_wall() const {
  double sum = contact_wall_before_;
  for (std::size_t k = 0; k < world_.size() && world_.tools() != nullptr; ++k) sum += world_.contact(k)->wall_s();
  if (world_.ply_contact() != nullptr) sum += world_.ply_contact()->wall_s();
  return sum;
}

// A motion far faster than what the program would choose breaks a fabric by its inertia, whatever the step.
std::string Analysis::what_to_do() const {
  if (is_hasty())
    return fmt::format("load it more slowly: the duration is {:.3g} s, and {:.3g} s would be chosen for this scene",
                       world_.duration(), automatic_duration(model_));
  return fmt::format("lower analysis.step_factor (now {})", scene_.analysis.step_factor);
}

bool Analysis::is_hasty() const {
  return scene_.analysis.step_factor <= 1.0 && world_.duration() < hasty_share * automatic_duration(model_);
}

void Analysis::fail(const std::string& what) const {
  outputs_.write_history_file();
  throw PhysicsError(fmt::format("at t = {:.4g} s, step {}: {}", world_.time(), world_.steps(), what));
}

}  // namespace weaveform
