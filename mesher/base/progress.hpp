// Progress of long work on stderr: a bar with rate and time left on a terminal, a plain line every tenth in a log,
// nothing when quiet.
#pragma once

#include <chrono>
#include <string>

namespace weaveform {

class Progress {
public:
  Progress(std::string title, bool quiet);
  // `fraction` of the work done, 0 to 1; `note` is appended (rate, energy ratio, ...). Cheap to call often.
  void update(double fraction, const std::string& note);
  void finish(const std::string& note);
  // Seconds between two updates worth making: 0.1 on a terminal; in a log only tenths are printed.
  [[nodiscard]] bool due(double fraction) const;

private:
  void print(double fraction, const std::string& note);
  using Clock = std::chrono::steady_clock;
  std::string title_;
  bool quiet_;
  bool terminal_;
  Clock::time_point start_;
  Clock::time_point printed_;
  double printed_fraction_ = -1.0;
  double start_fraction_ = -1.0;
};

}  // namespace weaveform
