// When a checkpoint is due by the wall clock: after the interval, and never so often that writing checkpoints would
// take more than a hundredth of the run.
#pragma once

#include <chrono>

namespace weaveform {

inline constexpr double most_checkpoint_share = 0.01;  // of the wall time

class CheckpointClock {
public:
  using Clock = std::chrono::steady_clock;
  // 0 minutes: never.
  explicit CheckpointClock(double minutes, Clock::time_point now = Clock::now());

  [[nodiscard]] bool due(Clock::time_point now = Clock::now()) const;
  // A checkpoint was written between these times.
  void note_written(Clock::time_point begin, Clock::time_point end = Clock::now());

  [[nodiscard]] int count() const { return count_; }     // checkpoints written
  [[nodiscard]] double spent() const { return spent_; }  // s; in writing them

private:
  double interval_;  // s
  Clock::time_point start_, last_;
  int count_ = 0;
  double spent_ = 0.0;
};

}  // namespace weaveform
