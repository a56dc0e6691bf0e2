// What an analysis leaves behind in case it is stopped, and how it goes on.
#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "solver/analysis/analysis.hpp"

namespace weaveform {

namespace {

constexpr long clock_look = 16;  // steps between looks at the clock, which costs a hundredth of the smallest step

}  // namespace

// Takes time, and only runs with a folder or a checkpoint need it.
const Identity& Analysis::identity() {
  if (identity_.empty()) identity_ = identity_of(model_, options_.program);
  return identity_;
}

// The frames and the index follow the mesh's number of nodes; files of the run before stay until the checkpoint is
// read.
void Analysis::open_result_files(std::vector<double> frame_times) {
  if (directory_.empty()) return;
  frames_ = std::make_unique<FrameWriter>(directory_, whole_, std::move(frame_times), tool_names());
  history_file_ =
      std::make_unique<HistoryFile>(directory_ / file_name::history, recorder_.history(), recorder_.closed_rows());
}

void Analysis::look_at_checkpoint() {
  const bool stop = (options_.stop_requested && options_.stop_requested()) ||
                    (options_.stop_at_step > 0 && state_.step >= options_.stop_at_step);
  const bool due = state_.step % clock_look == 0 && clock_.due();
  // what follows a perturbed run, the same without, takes as long again
  const bool before_clean_run = scene_.analysis.perturbation > 0.0 && finished();
  if (stop || due || before_clean_run) leave_checkpoint();
  if (!stop) return;
  if (checkpoint_file_.empty()) throw Interrupted("interrupted");
  throw Interrupted(fmt::format("stopped at t = {:.4g} s of {:.4g} s, step {}; go on with --resume ({})", state_.time,
                                duration_, state_.step, checkpoint_file_.string()));
}

void Analysis::leave_checkpoint() {
  if (checkpoint_file_.empty()) return;
  const auto begin = CheckpointClock::Clock::now();
  check_state();
  const Checkpoint now = checkpoint();
  if (!is_finite(now)) fail("a velocity or force is not a number; " + what_to_do());
  if (frames_) frames_->settle();
  if (clock_.count() == 0 && !directory_.empty())
    for (const char* name : {file_name::scene, file_name::mesh}) settle_on_disk(directory_ / name);
  write_text_whole(checkpoint_file_, checkpoint_bytes(now, identity()), Durability::power);
  clock_.note_written(begin);
}

Checkpoint Analysis::checkpoint() const {
  Checkpoint now{.state = state_,
                 .step_before = step_before_,
                 .step = step_,
                 .smallest_step = smallest_step_,
                 .step_set_by = step_set_by_,
                 .viscous_time = viscous_time_,
                 .reach = reach_.memory(),
                 .power_before = damping_power_before_,
                 .force_before = grip_force_before_,
                 .displacement_before = grip_displacement_before_,
                 .wall_s = wall(),
                 .next_row = row_schedule_.index(),
                 .next_frame = frame_schedule_.index(),
                 .frame_times = frames_ ? frames_->times() : std::vector<double>{},
                 .balance = balance_,
                 .grip_work = grip_work_,
                 .damping_work = damping_work_,
                 .worst_error = worst_error_,
                 .worst_ratio = worst_ratio_,
                 .folded = folded_,
                 .path = internal_energy_.path(),
                 .fabric = forces_.memory(),
                 .term_memory = {},
                 .row = recorder_.history().row,
                 .window = recorder_.window()};
  for (const auto& term : terms_) now.term_memory.push_back(term->memory());
  return now;
}

CheckpointSizes Analysis::checkpoint_sizes() const {
  CheckpointSizes size{
      .nodes = static_cast<std::size_t>(packed_.nodes),
      .grips = grips_.size(),
      .columns = recorder_.history().column.size(),
      .rows = static_cast<std::size_t>(scene_.output.history) + 1,
      .frames = static_cast<std::size_t>(scene_.output.frames) + 1,
      .impulses = recorder_.impulses(),
      .path_cells = static_cast<std::size_t>(scene_.model.formulation == "contravariant" ? mesh_.cells.size() : 0),
      .fabric = forces_.memory().size(),
      .term = {},
      .duration = duration_};
  for (const auto& term : terms_) size.term.push_back(term->memory().size());
  return size;
}

void Analysis::resume() {
  const std::string name = checkpoint_file_.string();
  Checkpoint kept = read_checkpoint(read_text_file(checkpoint_file_), identity(), checkpoint_sizes(), name);
  std::vector<double> frame_times = std::move(kept.frame_times);
  try {
    recall(std::move(kept));
  } catch (const FileError& error) {
    throw_damaged_checkpoint(name, error.what());
  }
  check_state();
  open_result_files(std::move(frame_times));
}

// The forces are those of the checkpoint, and everything that has a history stands behind them already.
void Analysis::recall(Checkpoint checkpoint) {
  for (std::size_t k = 0; k < terms_.size(); ++k) terms_[k]->recall(checkpoint.term_memory[k]);
  forces_.recall(checkpoint.fabric);
  state_ = std::move(checkpoint.state);
  step_before_ = checkpoint.step_before;
  step_ = checkpoint.step;
  smallest_step_ = checkpoint.smallest_step;
  step_set_by_ = checkpoint.step_set_by;
  reach_.recall(checkpoint.reach);
  yarn_modulus_ = critical_step_.stiffest(reach_.allowed());
  set_viscous_time(checkpoint.viscous_time);
  forces_.set_look_ahead(steps_ahead * step_);
  damping_power_before_ = checkpoint.power_before;
  grip_force_before_ = std::move(checkpoint.force_before);
  grip_displacement_before_ = std::move(checkpoint.displacement_before);
  wall_before_ = checkpoint.wall_s;
  row_schedule_.set_index(static_cast<int>(checkpoint.next_row));
  frame_schedule_.set_index(static_cast<int>(checkpoint.next_frame));
  balance_ = checkpoint.balance;
  grip_work_ = checkpoint.grip_work;
  damping_work_ = checkpoint.damping_work;
  worst_error_ = checkpoint.worst_error;
  worst_ratio_ = checkpoint.worst_ratio;
  folded_ = static_cast<int>(checkpoint.folded);
  internal_energy_.set_path(std::move(checkpoint.path));
  recorder_.restore(std::move(checkpoint.row), std::move(checkpoint.window));
}

}  // namespace weaveform
