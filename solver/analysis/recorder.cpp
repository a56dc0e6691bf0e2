#include "solver/analysis/recorder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weaveform {
namespace {

constexpr std::array tool_columns = {".displacement_mm", ".force_N",   ".contact_area_mm2",
                                     ".force_x_N",       ".force_y_N", ".force_z_N"};
constexpr int tool_width = static_cast<int>(tool_columns.size());
constexpr int tool_means = tool_width - 1;  // all but the displacement, in the columns' order

std::array<double, tool_means> means_of(const ToolReading& tool) {
  return {tool.force, tool.area, tool.whole_force[0], tool.whole_force[1], tool.whole_force[2]};
}

constexpr int most_plies_in_all_pairs = 8;
constexpr std::array pair_columns = {".contact_area_mm2", ".force_N",          ".slip_mm",         ".mean_slip_mm",
                                     ".pressure_MPa",     ".stored_energy_mJ", ".friction_work_mJ"};

std::array<double, pair_columns.size()> values_of(const PairReading& pair) {
  return {pair.area, pair.force, pair.greatest_slip, pair.mean_slip, pair.pressure, pair.stored, pair.friction_work};
}

}  // namespace

std::vector<std::array<int, 2>> recorded_pairs(int plies) {
  std::vector<std::array<int, 2>> pairs;
  for (int lower = 0; lower < plies; ++lower)
    for (int upper = lower + 1; upper < plies; ++upper)
      if (plies <= most_plies_in_all_pairs || upper == lower + 1) pairs.push_back({lower, upper});
  return pairs;
}

Recorder::Recorder(const std::vector<Grip>& grips, std::vector<Probe> probes, double duration, int rows)
    : grip_count_(static_cast<int>(grips.size())), probes_(std::move(probes)), duration_(duration), rows_(rows) {
  history_.column = {"time_s"};
  for (const auto& grip : grips) {
    history_.column.push_back(grip.name + ".displacement_mm");
    history_.column.push_back(grip.name + ".force_N");
  }
  for (const auto& probe : probes_)
    for (const char* what : {".shear_angle_deg", ".shear_angle_sd_deg", ".shear_angle_min_deg", ".shear_angle_max_deg"})
      history_.column.push_back(probe.name + what);
  for (const char* what : {"kinetic_energy_mJ", "internal_energy_mJ", "external_work_mJ", "damping_work_mJ",
                           "bending_energy_mJ", "hourglass_energy_mJ", "energy_error"})
    history_.column.emplace_back(what);
  window_.impulse.assign(grip_count_, 0.0);
}

void Recorder::record_bending_friction() {
  friction_column_ = history_.column.size();
  history_.column.emplace_back("bending_friction_work_mJ");
}

void Recorder::evaluate_frame(const ShearFrame& frame, int pulled) {
  frame_ = frame;
  pulled_ = pulled;
  frame_column_ = static_cast<int>(history_.column.size());
  history_.column.insert(history_.column.end(), {"frame.shear_angle_deg", "frame.normalised_shear_force_N_per_mm"});
}

void Recorder::record_tools(const std::vector<ToolSpec>& tools) {
  tool_count_ = static_cast<int>(tools.size());
  tool_column_ = static_cast<int>(history_.column.size());
  for (const auto& tool : tools)
    for (const char* what : tool_columns) history_.column.push_back(tool.name + what);
  window_.impulse.assign(grip_count_ + tool_means * tool_count_, 0.0);
}

void Recorder::record_plies(const MeshCells& cells, const std::vector<MeshPly>& plies) {
  ply_column_ = static_cast<int>(history_.column.size());
  for (const MeshPly& ply : plies) {
    first_cell_.push_back(ply.first_cell);
    history_.column.push_back(ply.name + ".max_shear_angle_deg");
  }
  first_cell_.push_back(cells.size());
  pairs_ = recorded_pairs(static_cast<int>(plies.size()));
  for (const auto& [lower, upper] : pairs_)
    for (const char* what : pair_columns) history_.column.push_back(plies[lower].name + "/" + plies[upper].name + what);
}

void Recorder::add_forces(double time, double kick, const std::vector<double>& force,
                          const std::vector<ToolReading>& tools) {
  const bool row_exists = window_.row < static_cast<int>(history_.row.size());
  if (row_exists && time > history_.row[window_.row].front() + 0.5 * duration_ / rows_) close_window();
  window_.elapsed += kick;
  for (int g = 0; g < grip_count_; ++g) window_.impulse[g] += kick * force[g];
  for (int t = 0; t < tool_count_; ++t) {
    const auto means = means_of(tools[t]);
    for (int k = 0; k < tool_means; ++k) window_.impulse[grip_count_ + tool_means * t + k] += kick * means[k];
  }
}

void Recorder::close_window() {
  if (window_.elapsed > 0.0 && window_.row < static_cast<int>(history_.row.size())) {
    auto& row = history_.row[window_.row];
    for (int g = 0; g < grip_count_; ++g) row[2 + 2 * g] = window_.impulse[g] / window_.elapsed;
    for (int t = 0; t < tool_count_; ++t)
      for (int k = 0; k < tool_means; ++k)
        row[tool_column_ + tool_width * t + 1 + k] =
            window_.impulse[grip_count_ + tool_means * t + k] / window_.elapsed;
    if (frame_) {
      const double angle = frame_shear_angle(*frame_, row[1 + 2 * pulled_]);
      row[frame_column_] = angle * 180.0 / std::numbers::pi;
      row[frame_column_ + 1] = normalised_shear_force(*frame_, row[2 + 2 * pulled_], angle);
    }
  }
  window_.elapsed = 0.0;
  window_.impulse.assign(grip_count_ + tool_means * tool_count_, 0.0);
  ++window_.row;
}

void Recorder::add_row(double time, const std::vector<double>& displacement, const Fields& fields,
                       const EnergyBalance& balance, const std::vector<ToolReading>& tools,
                       const std::vector<PairReading>& pairs) {
  if (window_.row < static_cast<int>(history_.row.size())) close_window();  // steps longer than half a row
  std::vector<double> row = {time};
  for (int g = 0; g < grip_count_; ++g) {
    row.push_back(displacement[g]);
    row.push_back(0.0);
  }
  for (const auto& probe : probes_) {
    const auto shear = shear_statistics(probe, fields);
    row.insert(row.end(), {shear.mean, shear.deviation, shear.least, shear.greatest});
  }
  row.insert(row.end(), {balance.kinetic, balance.internal, balance.external, balance.damping, balance.bending,
                         balance.hourglass, balance.error()});
  row.resize(history_.column.size(), 0.0);
  if (friction_column_) row[*friction_column_] = balance.bending_friction;
  for (int t = 0; t < tool_count_; ++t) row[tool_column_ + tool_width * t] = tools[t].displacement;
  add_plies(fields, pairs, row);
  history_.row.push_back(std::move(row));
}

void Recorder::add_plies(const Fields& fields, const std::vector<PairReading>& pairs, std::vector<double>& row) const {
  int column = ply_column_;
  for (std::size_t k = 0; k + 1 < first_cell_.size(); ++k) {
    double most = 0.0;
    for (int cell = first_cell_[k]; cell < first_cell_[k + 1]; ++cell)
      most = std::max(most, std::abs(fields.shear_angle[cell]));
    row[column++] = most * 180.0 / std::numbers::pi;
  }
  for (const auto& plies : pairs_) {
    const auto reading = std::find_if(pairs.begin(), pairs.end(), [&](const PairReading& pair) {
      return std::array{pair.lower, pair.upper} == plies;
    });
    for (const double value : reading == pairs.end() ? values_of({}) : values_of(*reading)) row[column++] = value;
  }
}

void Recorder::finish() {
  close_window();
}

void Recorder::archive(Archive& archive) {
  const auto most_rows = static_cast<std::size_t>(rows_) + 1;
  history_.row.resize(archive.length("rows of history", history_.row.size(), 0, most_rows));
  for (auto& row : history_.row) {
    row.resize(history_.column.size());
    archive.numbers("a row of history", row, anything);
  }
  archive.number("a window's time", window_.elapsed, not_negative);
  archive.numbers("an impulse", window_.impulse);
  std::int64_t row = window_.row;
  archive.count("a window's row", row, 0, static_cast<std::int64_t>(history_.row.size()));
  window_.row = static_cast<int>(row);
}

}  // namespace weaveform
