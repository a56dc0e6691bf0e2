#include "solver/motion/recorder.hpp"

namespace weaveform {

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
  for (const char* what :
       {"kinetic_energy_mJ", "internal_energy_mJ", "external_work_mJ", "damping_work_mJ", "energy_error"})
    history_.column.emplace_back(what);
  window_.impulse.assign(grip_count_, 0.0);
}

void Recorder::add_forces(double time, double kick, const std::vector<double>& force) {
  const bool row_exists = window_.row < static_cast<int>(history_.row.size());
  if (row_exists && time > history_.row[window_.row].front() + 0.5 * duration_ / rows_) close_window();
  window_.elapsed += kick;
  for (int g = 0; g < grip_count_; ++g) window_.impulse[g] += kick * force[g];
}

void Recorder::close_window() {
  if (window_.elapsed > 0.0 && window_.row < static_cast<int>(history_.row.size()))
    for (int g = 0; g < grip_count_; ++g) history_.row[window_.row][2 + 2 * g] = window_.impulse[g] / window_.elapsed;
  window_.elapsed = 0.0;
  window_.impulse.assign(grip_count_, 0.0);
  ++window_.row;
}

void Recorder::add_row(double time, const std::vector<double>& displacement, const Fields& fields,
                       const EnergyBalance& balance) {
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
  row.insert(row.end(), {balance.kinetic, balance.internal, balance.external, balance.damping, balance.error()});
  history_.row.push_back(std::move(row));
}

void Recorder::finish() {
  close_window();
}

void Recorder::restore(History history, Window window) {
  history_ = std::move(history);
  window_ = std::move(window);
}

}  // namespace weaveform
