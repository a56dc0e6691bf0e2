// Whether a team works together or its caller alone, from the time that steps take: where loops are short, or the machine
// is busy with something else, waiting for each other costs more than help brings. Both ways are tried for some
// milliseconds, the faster one is kept for half a second (a twentieth of one at first), then they are compared again.
// Results do not depend on it.
#pragma once

#include "solver/state/team.hpp"

namespace weaveform {

class Pace {
public:
  Pace();
  // Called before every step with the time on any clock, s. True while the team is to work together. `plain`: the step
  // just made was one as most are; what else it did would be held against the way at hand.
  [[nodiscard]] bool together(double now, bool plain = true);

private:
  enum class Phase { first_steps, way_at_hand, other_way, kept };
  void begin(Phase phase, double now);

  Phase phase_ = Phase::first_steps;
  bool together_ = true;
  bool started_ = false;
  double start_ = 0.0;      // s; of the phase, later by what its steps that were not plain took
  double last_ = 0.0;       // s; of the last call
  int steps_ = 0;           // made in it,
  int left_out_ = 0;        // and those that do not count: no more than others
  double step_time_ = 0.0;  // s; of the way at hand
  double trial_ = 0.0;      // s; that it took
  double kept_for_ = 0.0;   // s
  double kept_share_;       // 1; of the whole time that a way is kept
};

// A frame on its way to its file takes a core, often the one that a team's second thread would have: which way is faster
// then, and which when nothing is beside, are two questions, each asked in its own time.
class TwoPaces {
public:
  // As Pace's; `plain` is of the step just made, `beside` of the step that begins.
  [[nodiscard]] bool together(double now, bool plain, bool beside);

private:
  struct Its {
    Pace pace;
    double time = 0.0;     // s; of all its steps
    bool together = true;  // in its next one
  };
  Its quiet_, beside_;
  Its* of_step_ = nullptr;  // whose step was just made
  double last_ = 0.0;       // s
};

// Keeps a team's pace by the clock of the machine.
class PaceKeeper {
public:
  explicit PaceKeeper(Team& team) : team_(team) {}
  // Before every step; `beside`: another thread of the run is at work.
  void next_step(bool beside);
  // Of the step at work: it writes, or looks for the stable step, which one thread does.
  void not_plain() { plain_ = false; }

private:
  Team& team_;
  TwoPaces pace_;
  bool plain_ = true;
};

}  // namespace weaveform
