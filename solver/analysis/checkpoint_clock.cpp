#include "solver/analysis/checkpoint_clock.hpp"

namespace weaveform {

CheckpointClock::CheckpointClock(double minutes, Clock::time_point now)
    : interval_(60.0 * minutes), start_(now), last_(now) {}

bool CheckpointClock::due(Clock::time_point now) const {
  const auto since = [&](Clock::time_point then) { return std::chrono::duration<double>(now - then).count(); };
  return interval_ > 0.0 && since(last_) >= interval_ && since(start_) >= spent_ / most_checkpoint_share;
}

void CheckpointClock::note_written(Clock::time_point begin, Clock::time_point end) {
  ++count_;
  spent_ += std::chrono::duration<double>(end - begin).count();
  last_ = end;
}

}  // namespace weaveform
