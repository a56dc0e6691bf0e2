// What an analysis leaves behind when it is interrupted, and how it goes on.
#include <fmt/format.h>

#include "mesher/base/error.hpp"
#include "solver/motion/analysis.hpp"

namespace weaveform {

std::string Analysis::identity() const {
  return fmt::format(
      "{} nodes, {} yarns, {} cells, {} {} {} {} {}, duration {:.17g}, damping {:.17g}, factor {:.17g} of the {} step, "
      "mass x "
      "{:.17g}, rows {}, frames {}",
      mesh_.node_count(), mesh_.yarn_count(), mesh_.cells.size(), card_.name, scene_.model.yarn, scene_.model.cell,
      scene_.model.formulation, scene_.model.thickness, duration_, loading_.damping, scene_.analysis.step_factor,
      scene_.analysis.step_bound, scene_.analysis.mass_scale, scene_.output.history, scene_.output.frames);
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
      .reach = reach_.memory(),
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
  reach_.recall(checkpoint.reach);
  yarn_modulus_ = critical_step_.stiffest(reach_.allowed());
  set_viscous_time(checkpoint.viscous_time);
  forces_.set_look_ahead(steps_ahead * step_);
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

}  // namespace weaveform
