// Output times t_k = k T / count, k = 0 .. count: due at the first step that reaches them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/state/archive.hpp"

namespace weaveform {

class Schedule {
public:
  Schedule(double duration, int count) : duration_(duration), count_(count) {}
  // Time of the next output (s), the duration itself for the last one.
  [[nodiscard]] double next() const { return next_ >= count_ ? duration_ : duration_ * next_ / count_; }
  [[nodiscard]] bool due(double time) const { return next_ <= count_ && time >= next() * (1.0 - 1e-12); }
  void advance(double time) {
    while (due(time)) ++next_;
  }
  // `written`: outputs there are, which are not more than what was due.
  void archive(Archive& archive, std::size_t written) {
    std::int64_t next = next_;
    archive.count("an output's number", next, static_cast<std::int64_t>(written), std::int64_t{count_} + 1);
    next_ = static_cast<int>(next);
  }

private:
  double duration_;
  int count_;
  int next_ = 0;
};

}  // namespace weaveform
