#include "solver/motion/checkpoint_clock.hpp"

#include <algorithm>

namespace weaveform {

CheckpointClock::CheckpointClock(double minutes, Clock::time_point now)
    : interval_(60.0 * minutes), last_(now), pause_(interval_) {}

bool CheckpointClock::due(Clock::time_point now) const {
  return interval_ > 0.0 && std::chrono::duration<double>(now - last_).count() >= pause_;
}

void CheckpointClock::note_written(Clock::time_point begin, Clock::time_point end) {
  const double cost = std::chrono::duration<double>(end - begin).count();
  ++count_;
  spent_ += cost;
  last_ = end;
  pause_ = std::max(interval_, cost / most_checkpoint_share);
}

}  // namespace weaveform
