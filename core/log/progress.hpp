// Progress of long work on stderr: a bar with rate and time left on a terminal, redrawn in place and never wider than
// the terminal is at that moment; a plain line every tenth in a log; nothing when quiet.
#pragma once

#include <chrono>
#include <string>

namespace weaveform {

// The bar's line without its end, in `columns` - 1 characters at most, so that no terminal wraps it. What `note` holds
// between double blanks is left out from its end where it does not fit, then the bar gets shorter and goes.
[[nodiscard]] std::string progress_line(const std::string& title, double fraction, const std::string& note,
                                        const std::string& left, int columns);

class Progress {
public:
  Progress(std::string title, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // `fraction` of the work done, 0 to 1; `note`: rate first, then what matters less, double blanks between them. Cheap
  // to call often.
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
