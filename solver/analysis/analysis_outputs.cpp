// What an analysis writes and judges as it goes: frames, rows of history, the energy balance, statistics.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/files/digest.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/ply/strain_error.hpp"

namespace weaveform {
namespace {

constexpr double start_fraction = 0.1;     // of the duration; the energy balance is judged after it
constexpr double rounding_energy = 1e-15;  // mJ; a fabric on which nothing acts has less, and no balance to judge
constexpr double start_travel = 0.1;  // of the travel; kinetic/internal is judged after it (before, both are near zero)

}  // namespace

std::vector<std::string> Analysis::tool_names() const {
  std::vector<std::string> names;
  for (const auto& tool : scene_.tools) names.push_back(tool.name);
  return names;
}

const std::vector<ToolReading>& Analysis::tool_readings() const {
  static const std::vector<ToolReading> none;
  return contact_ != nullptr ? contact_->readings() : none;
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
  check_state();
  const auto position = mesh_positions(packed_, state_);
  const auto whole_position = part_ != nullptr ? unfold(*part_, whole_, position) : position;
  // the last row's are what a run ends with
  fields_ = frame_due || finished() ? compute_fields(whole_, card_, scene_.model, time, whole_position)
                                    : compute_row_fields(whole_, plane_, time, whole_position, !scene_.measure.empty());
  if (frame_due) {
    if (contact_ != nullptr) fields_.contact = whole_contact_state();
    if (frames_) {
      frames_->write(fields_);
      write_statistics(statistics(), directory_ / file_name::statistics);
    }
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

// Part of the travel made, the least of all grips and tools.
double Analysis::travelled() const {
  const double part = fields_.time / duration_;
  double least = smooth_step(part);
  for (const auto& tool : scene_.tools)
    if (!tool.speed.empty()) least = std::min(least, travel_part(tool.speed, part));
  return least;
}

void Analysis::close_row() {
  row_open_ = false;
  balance_.note_greatest();
  const double error = balance_.error();
  // the row's forces follow when their window closes; this step's open the next window when it is later than that
  recorder_.add_row(fields_.time, displacement_, fields_, balance_, tool_readings());
  if (fields_.time > start_fraction * duration_) {
    // not a number is judged too
    const bool judged = !(std::max({balance_.internal, balance_.kinetic, balance_.damping}) <= rounding_energy);
    if (judged) worst_error_ = std::max(worst_error_, error);
    const bool under_way = travelled() > start_travel;
    if (under_way && balance_.internal > 0.0)
      worst_ratio_ = std::max(worst_ratio_, balance_.kinetic / balance_.internal);
    if (judged && !(error <= scene_.analysis.energy_limit))
      fail(fmt::format(
          "the energy balance is off by {:.3g} % of the greatest energy (limit {:.3g} %): internal {:.4g}, kinetic "
          "{:.4g}, damping {:.4g}, external {:.4g} mJ; {}",
          100.0 * error, 100.0 * scene_.analysis.energy_limit, balance_.internal, balance_.kinetic, balance_.damping,
          balance_.external, what_to_do()));
  }
}

void Analysis::report_progress() {
  const double fraction = state_.time / duration_;
  if (options_.quiet || !options_.progress.is_due(fraction)) return;
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  const double rate = wall > 0.0 ? static_cast<double>(state_.step) * mesh_.cells.size() / wall : 0.0;
  options_.progress.update(
      fraction, fmt::format("{:.1f} M cell-steps/s  step {}  kinetic/internal {:.2g}", 1e-6 * rate, state_.step,
                            balance_.internal > 0.0 ? balance_.kinetic / balance_.internal : 0.0));
}

double Analysis::wall() const {
  return wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

// Of the open row or frame.
SolveStatistics Analysis::statistics() {
  SolveStatistics s;
  s.finished = false;
  s.time_s = fields_.time;
  s.program = options_.program;
  s.scene = options_.scene_name;
  s.scene_digest = digest_of(identity());
  s.card_digest = digest_of(card_to_toml(card_));
  s.mesh_digest = mesh_digest(whole_);
  s.cells = whole_.cells.size();
  s.nodes = whole_.node_count();
  s.yarns = whole_.yarn_count();
  s.symmetry = parts_ == 4 ? "quarter" : parts_ == 2 ? "half" : "none";
  s.cells_solved = mesh_.cells.size();
  s.steps = state_.step;
  s.duration_s = duration_;
  s.wall_s = wall();
  s.checkpoint_wall_s = clock_.spent();
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
  s.threads = team_.threads();
  if (contact_ != nullptr) {
    const Contact::Cost cost = contact_->cost();
    s.contact_penetration = cost.penetration;
    s.friction_work_mJ = parts_ * cost.friction_work;
    s.contact_damping_work_mJ = parts_ * cost.damping_work;
    s.contact_wall_s = cost.wall_s;
  }
  const double mass_scale = scene_.analysis.mass_scale;
  for (const double mass : whole_.nodes.mass) s.added_mass_t += mass * (1.0 - 1.0 / mass_scale);
  s.yarn_strain_error = yarn_strain_error(whole_, card_, scene_.model, fields_.yarn_strain);
  if (scene_.frame && !scene_.frame->rigid) {
    const auto& frame = *scene_.frame;
    s.added_mass_t += (frame.mass_scale - 1.0) * 4.0 * frame.density * frame.section * frame.length;
  }
  return s;
}

SolveResult Analysis::result() {
  SolveResult result;
  result.history = recorder_.history();
  result.position = fields_.position;
  result.statistics = statistics();
  result.statistics.finished = true;
  if (frames_) frames_->settle();
  if (!directory_.empty()) write_history(result.history, directory_ / file_name::history);
  return result;
}

}  // namespace weaveform
