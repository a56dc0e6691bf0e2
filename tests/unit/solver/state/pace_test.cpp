// A team works together where that is faster, by the steps' own time.
#include "solver/state/pace.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace weaveform {
namespace {

// A run whose steps take so long alone and together, s; what share of its time the team worked together.
struct PacedRun {
  Pace pace;
  double now = 100.0, time_together = 0.0;
  int steps = 0;
  int row_every = 0;       // steps; 0: never
  double row_takes = 0.0;  // s; of one thread

  double share_together(double alone, double together, double duration) {
    const double start = now;
    time_together = 0.0;
    double in_rows = 0.0;
    bool plain = true;
    while (now < start + duration) {
      const bool team = pace.together(now, plain);
      now += team ? together : alone;
      time_together += team ? together : 0.0;
      ++steps;
      plain = row_every == 0 || steps % row_every != 0;
      if (plain) continue;
      now += row_takes;
      in_rows += row_takes;
    }
    return time_together / (now - start - in_rows);
  }
};

TEST(Pace, KeepsTheTeamTogetherWhereItIsFaster) {
  for (const double step : {1e-6, 2e-5, 1e-3, 0.2})
    EXPECT_GT(PacedRun().share_together(step, 0.6 * step, 200.0), 0.9) << step;
}

TEST(Pace, SetsTheTeamAsideWhereItIsNot) {
  for (const double step : {1e-6, 2e-5, 1e-3})
    EXPECT_LT(PacedRun().share_together(step, 1.3 * step, 20.0), 0.03) << step;
}

TEST(Pace, LosesLittleOnABusyMachine) {
  PacedRun run;
  const double duration = 20.0, step = 2e-5;
  (void)run.share_together(step, 80.0 * step, duration);
  EXPECT_LT(duration, 1.05 * run.steps * step);
}

TEST(Pace, FollowsAChangeWithinSeconds) {
  PacedRun run;
  EXPECT_GT(run.share_together(2e-5, 1e-5, 5.0), 0.9);
  (void)run.share_together(2e-5, 4e-5, 1.5);
  EXPECT_LT(run.share_together(2e-5, 4e-5, 5.0), 0.05);
  (void)run.share_together(2e-5, 1e-5, 1.5);
  EXPECT_GT(run.share_together(2e-5, 1e-5, 5.0), 0.9);
}

// Memory that is touched for the first time, tools that meet the fabric: what the first steps tell lasts for a twentieth
// of a second.
TEST(Pace, ASlowStartIsNotHeldAgainstTheTeam) {
  for (const double slow_for : {0.002, 0.008, 0.02}) {
    PacedRun run;
    (void)run.share_together(1e-4, 3e-4, slow_for);
    EXPECT_GT(run.share_together(1e-4, 6e-5, 1.0), 0.8) << slow_for;
  }
}

// A row of history may take as long as thirty steps, and fall into the trial of either way.
TEST(Pace, WhatOneThreadDoesIsHeldAgainstNeitherWay) {
  for (const int every : {13, 31, 50, 70, 97, 150}) {
    PacedRun faster, slower;
    faster.row_every = slower.row_every = every;
    faster.row_takes = slower.row_takes = 3e-3;
    EXPECT_GT(faster.share_together(1e-4, 7e-5, 3.0), 0.9) << every;
    EXPECT_LT(slower.share_together(1e-4, 1.3e-4, 3.0), 0.15) << every;
  }
}

TEST(Pace, AStepThatIsNeverPlainCountsAllTheSame) {
  PacedRun run;
  run.row_every = 1;
  run.row_takes = 1e-5;
  EXPECT_LT(run.share_together(1e-4, 1.3e-4, 20.0), 0.05);
}

TEST(Pace, LeavesACoreToOthersForAGainThatIsNone) {
  EXPECT_LT(PacedRun().share_together(2e-5, 1.99e-5, 20.0), 0.03);
}

// A run whose frames, from the first step on, are written beside it by a thread that takes a core: so long, so often.
struct RunWithFrames {
  TwoPaces pace;
  double now = 100.0;

  struct Shares {
    double quiet, beside;  // of the time with and without, worked together
  };
  Shares shares_together(double team_quiet, double team_beside, double duration) {
    constexpr double alone = 1e-4, frame_every = 0.07, frame_takes = 0.03;  // s
    const double start = now;
    double together[2] = {0.0, 0.0}, all[2] = {0.0, 0.0};
    while (now < start + duration) {
      const bool beside = std::fmod(now - start, frame_every) < frame_takes, team = pace.together(now, true, beside);
      const double takes = !team ? alone : (beside ? team_beside : team_quiet);
      now += takes;
      all[beside ? 1 : 0] += takes;
      together[beside ? 1 : 0] += team ? takes : 0.0;
    }
    return {together[0] / all[0], together[1] / all[1]};
  }
};

TEST(TwoPaces, AFrameThatTakesACoreIsNotHeldAgainstTheTeam) {
  const auto shares = RunWithFrames().shares_together(6e-5, 1.8e-4, 2.0);
  EXPECT_GT(shares.quiet, 0.9);
  EXPECT_LT(shares.beside, 0.1);
}

TEST(TwoPaces, WhereCoresAreLeftTheTeamStaysTogetherBesideAFrame) {
  const auto shares = RunWithFrames().shares_together(6e-5, 6e-5, 2.0);
  EXPECT_GT(shares.quiet, 0.9);
  EXPECT_GT(shares.beside, 0.9);
}

TEST(TwoPaces, ATeamThatNeverHelpsIsSetAsideAtAllTimes) {
  const auto shares = RunWithFrames().shares_together(1.3e-4, 1.8e-4, 4.0);
  EXPECT_LT(shares.quiet, 0.1);
  EXPECT_LT(shares.beside, 0.1);
}

}  // namespace
}  // namespace weaveform
