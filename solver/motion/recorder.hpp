// Fills the history while the analysis runs. Grip forces of an explicit run carry the yarns' vibrations, so a row's
// force is the mean over the time from half a row before to half a row after it (the impulse over the time), not an
// instant's value.
#pragma once

#include <vector>

#include "solver/motion/balance.hpp"
#include "solver/motion/grips.hpp"
#include "solver/result/probe.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

class Recorder {
public:
  Recorder(const std::vector<Grip>& grips, std::vector<Probe> probes, double duration, int rows);

  // Adds the grips' forces (N, along their directions) over `kick` seconds around `time`.
  void add_forces(double time, double kick, const std::vector<double>& force);
  // Appends the row of `time`; its forces are filled in when their window closes.
  void add_row(double time, const std::vector<double>& displacement, const Fields& fields,
               const EnergyBalance& balance);
  // Closes the last window.
  void finish();

  [[nodiscard]] const History& history() const { return history_; }

  // What a checkpoint must keep.
  struct Window {
    double elapsed = 0.0;         // s
    std::vector<double> impulse;  // N s
    int row = 0;                  // the row this window belongs to
  };
  [[nodiscard]] const Window& window() const { return window_; }
  void restore(History history, Window window);

private:
  void close_window();
  int grip_count_;
  std::vector<Probe> probes_;
  double duration_;
  int rows_;
  History history_;
  Window window_;
};

}  // namespace weaveform
