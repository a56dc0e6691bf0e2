#include "solver/state/pace.hpp"

#include <algorithm>
#include <chrono>

namespace weaveform {
namespace {

constexpr double trial_time = 4e-3;   // s; a hundred steps of a mesh of thousand cells
constexpr int trial_steps = 8;        // at least
constexpr double kept_time = 0.5;     // s; at least,
constexpr double kept_trials = 50.0;  // and so many times as long as the longer trial took
constexpr double first_kept = 0.1;    // of that: a run's first steps are none like those that follow,
constexpr double longer_kept = 2.0;   // times as long each time, up to the whole
constexpr double worth_it = 0.97;     // of the time alone: a core for less is better left to others
constexpr double hopeless = 3.0;      // times slower: no need to see the trial's end

}  // namespace

Pace::Pace() : kept_share_(first_kept) {}

void Pace::begin(Phase phase, double now) {
  phase_ = phase;
  start_ = now;
  steps_ = left_out_ = 0;
}

bool Pace::together(double now, bool plain) {
  const double took = now - last_;
  last_ = now;
  if (!started_) {
    started_ = true;
    begin(Phase::first_steps, now);
    return together_;
  }
  if (!plain && left_out_ <= steps_) {
    ++left_out_;
    start_ += took;
    return together_;
  }
  ++steps_;
  const double time = now - start_, step_time = time / steps_;
  const bool seen = time >= trial_time && steps_ >= trial_steps;
  switch (phase_) {
    case Phase::first_steps:  // touch memory for the first time
      if (seen) begin(Phase::way_at_hand, now);
      break;
    case Phase::way_at_hand:
      if (!seen) break;
      step_time_ = step_time;
      trial_ = time;
      together_ = !together_;
      begin(Phase::other_way, now);
      break;
    case Phase::other_way: {
      if (!seen && !(time >= trial_time && step_time > hopeless * step_time_)) break;
      const double of_team = together_ ? step_time : step_time_, of_one = together_ ? step_time_ : step_time;
      together_ = of_team < worth_it * of_one;
      kept_for_ = kept_share_ * std::max(kept_time, kept_trials * std::max(trial_, time));
      kept_share_ = std::min(1.0, longer_kept * kept_share_);
      begin(Phase::kept, now);
      break;
    }
    case Phase::kept:
      if (time >= kept_for_) begin(Phase::way_at_hand, now);
  }
  return together_;
}

bool TwoPaces::together(double now, bool plain, bool beside) {
  if (of_step_ != nullptr) {
    of_step_->time += now - last_;
    of_step_->together = of_step_->pace.together(of_step_->time, plain);
  }
  last_ = now;
  of_step_ = beside ? &beside_ : &quiet_;
  return of_step_->together;
}

void PaceKeeper::next_step(bool beside) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  team_.set_together(pace_.together(std::chrono::duration<double>(now).count(), plain_, beside));
  plain_ = true;
}

}  // namespace weaveform
