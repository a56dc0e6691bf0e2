// Output times t_k = k T / count, k = 0 .. count: due at the first step that reaches them.
#pragma once

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
  [[nodiscard]] int index() const { return next_; }
  void set_index(int index) { next_ = index; }

private:
  double duration_;
  int count_;
  int next_ = 0;
};

}  // namespace weaveform
