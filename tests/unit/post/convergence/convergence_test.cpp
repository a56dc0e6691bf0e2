// Convergence on manufactured sequences f = F + C h^p, whose order and limit are known.
#include "post/convergence/convergence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace weaveform {
namespace {

std::vector<Level> sequence(const std::vector<double>& sizes, double limit, double factor, double order) {
  std::vector<Level> levels;
  for (const double h : sizes) levels.push_back({h, limit + factor * std::pow(h, order)});
  return levels;
}

// Halving, unequal ratios either way, and nearly equal sizes.
const std::vector<std::vector<double>> size_zoo = {{1, 2, 4}, {1, 1.3, 4}, {0.2, 0.9, 1.1}, {4.783, 10.16, 20.33}};

TEST(Convergence, FindsOrderAndLimitOfAnyRatios) {
  for (const auto& sizes : size_zoo) {
    for (const double order : {0.5001, 1.0, 1.37, 2.0}) {
      for (const double factor : {0.3, -0.02}) {
        const Convergence found = converge(sequence(sizes, 7.0, factor, order));
        EXPECT_EQ(found.trend, Trend::monotone);
        // differences of the levels keep about 12 digits
        EXPECT_NEAR(found.order, order, 1e-7);
        EXPECT_NEAR(found.limit, 7.0, 1e-7);
      }
    }
  }
}

TEST(Convergence, DoesNotDependOnTheOrderLevelsAreGivenIn) {
  const auto levels = sequence({1, 2, 4}, 7.0, 0.3, 1.5);
  EXPECT_DOUBLE_EQ(converge(levels).limit, converge({levels[2], levels[0], levels[1]}).limit);
}

// NASA's NPARC tutorial of spatial convergence: pressure recovery on three grids, p = 1.786170, limit 0.971300, index
// of the finest 0.103083 %.
TEST(Convergence, IsThePublishedExampleOfTheIndex) {
  const Convergence found = converge({{1, 0.97050}, {2, 0.96854}, {4, 0.96178}});
  EXPECT_NEAR(found.order, 1.786170, 1e-6);
  EXPECT_NEAR(found.limit, 0.971300, 5e-7);
  EXPECT_NEAR(found.index, 0.00103083, 5e-9);
}

TEST(Refinement, BoundOfTheFinestLevelIsTheIndexWhereLevelsAgree) {
  const Refinement refinement = refine(sequence({1, 2, 4, 8}, 100.0, 0.5, 1.0));
  // relative to the limit here, to the finest result there
  EXPECT_NEAR(refinement.error_bound[0] * 100.0, refinement.finest.index * 100.5, 1e-10);
  EXPECT_NEAR(refinement.uncertainty, 0.25 * 0.5, 1e-10);
}

TEST(Refinement, ThreeLevelsAreNotTrustedAsFour) {
  const Refinement refinement = refine(sequence({1, 2, 4}, 100.0, 0.5, 1.0));
  EXPECT_NEAR(refinement.limit, 100.0, 1e-10);
  EXPECT_NEAR(refinement.uncertainty, 3.0 * 0.5 / (std::sqrt(2.0) - 1.0), 1e-10);
  EXPECT_NEAR(refinement.finest.index, 1.25 * 0.5 / 100.5, 1e-10) << "Roache's index stays what it is";
}

// The hemisphere example at coarsening 8, 4, 2, 1 and 1/2: what any three or more neighbours promise must hold for the
// levels finer than they, although observed orders of 1.96 and 1.17 look sound and the plain index does not hold.
TEST(Refinement, BoundsOfMeasuredLevelsHoldForFinerOnes) {
  const std::vector<double> size = {39.36, 19.68, 9.84, 4.92, 2.46};
  const std::vector<double> angle = {43.6085, 50.9831, 52.8823, 54.0731, 53.7254};
  const std::vector<double> force = {539.690, 505.714, 513.778, 517.371, 506.135};
  for (const auto& result : {angle, force}) {
    for (std::size_t first = 0; first < 2; ++first) {
      for (std::size_t end = first + 3; end < 5; ++end) {
        std::vector<Level> levels;
        for (std::size_t i = first; i < end; ++i) levels.push_back({size[i], result[i]});
        const Refinement refinement = refine(levels);
        for (std::size_t finer = end; finer < 5; ++finer)
          EXPECT_LE(std::abs(result[finer] - refinement.limit), refinement.uncertainty) << first << " " << end;
      }
    }
  }
  const Convergence index = converge({{19.68, 505.714}, {9.84, 513.778}, {4.92, 517.371}});
  EXPECT_GT(std::abs(506.135 - index.limit), index.uncertainty);
}

TEST(Convergence, WhatIsNotAsymptoticHasNoLimitButABroadBound) {
  struct Case {
    std::array<double, 3> result;  // finest first
    Trend trend;
  };
  for (const auto& [result, trend] :
       {Case{{1.0, 1.1, 1.0}, Trend::oscillating}, Case{{1.0, 1.0, 1.1}, Trend::oscillating},
        Case{{1.0, 1.1, 1.15}, Trend::diverging}, Case{{1.0, 1.1, 1.21}, Trend::slow}}) {
    const Convergence found = converge({{1, result[0]}, {2, result[1]}, {4, result[2]}});
    EXPECT_EQ(found.trend, trend) << trend_words(found.trend);
    EXPECT_EQ(found.limit, result[0]);
    EXPECT_GT(found.uncertainty, 0.5) << "a spread of 0.1 promises nothing finer";
  }
}

TEST(Convergence, OrderAboveTheSchemesIsNotTrusted) {
  const Convergence found = converge(sequence({1, 2, 4}, 7.0, 0.01, 5.0));
  EXPECT_EQ(found.trend, Trend::fast);
  EXPECT_NEAR(found.order, 5.0, 1e-7);
  EXPECT_GE(found.uncertainty, std::abs(found.limit - 7.0)) << "the truth lies inside the bound";
  EXPECT_EQ(converge(sequence({1, 2, 4}, 7.0, 0.01, 5.0), 6.0).trend, Trend::monotone);
}

TEST(Convergence, OfAResultThatDoesNotChangeIsDone) {
  const Convergence found = converge({{1, 36.1}, {2, 36.1}, {4, 36.1}});
  EXPECT_EQ(found.trend, Trend::unchanging);
  EXPECT_LT(found.index, 1e-11);
  EXPECT_EQ(refine({{1, 0.0}, {2, 0.0}, {4, 0.0}}).error_bound[0], 0.0);
}

TEST(Convergence, NeedsThreeLevelsThatDiffer) {
  EXPECT_THROW((void)converge({{1, 1}, {2, 2}}), InputError);
  EXPECT_THROW((void)converge({{1, 1}, {2, 2}, {2, 3}}), InputError);
  EXPECT_THROW((void)converge({{0, 1}, {2, 2}, {4, 3}}), InputError);
  EXPECT_THROW((void)converge({{1, std::numeric_limits<double>::quiet_NaN()}, {2, 2}, {4, 3}}), InputError);
}

// A grip that bears hardly any load has no relative error of its own.
TEST(Refinement, ErrorsMayBeRelativeToAnotherScale) {
  const auto levels = sequence({1, 2, 4, 8}, 0.0, 0.01, 1.0);
  EXPECT_GT(refine(levels).error_bound[0], 1e6);
  EXPECT_NEAR(refine(levels, 2.0, 10.0).error_bound[0], 1.25 * 0.01 / 10.0, 1e-10);
}

TEST(Refinement, CoarsestLevelWithinATolerance) {
  // F = 100, errors 1, 2, 4, 8 %; with a quarter of the finest error on top 1.25, 2.25, 4.25, 8.25 %.
  const Refinement refinement = refine(sequence({1, 2, 4, 8}, 100.0, 1.0, 1.0));
  EXPECT_EQ(coarsest_within(refinement, 0.09), 3);
  EXPECT_EQ(coarsest_within(refinement, 0.0426), 2);
  EXPECT_EQ(coarsest_within(refinement, 0.0224), 0);
  EXPECT_EQ(coarsest_within(refinement, 0.0124), -1);
  EXPECT_TRUE(refinement.checked);
  EXPECT_TRUE(refinement.agreed);
}

// A coarse level may hit the limit by chance between two that miss it.
TEST(Refinement, ALuckyLevelIsNotChosen) {
  const Refinement refinement = refine({{1, 100.1}, {2, 100.2}, {4, 100.4}, {8, 110.0}, {16, 100.0}});
  EXPECT_EQ(coarsest_within(refinement, 0.02), 2);
}

TEST(Refinement, LevelsThatTellDifferentLimitsDoNotAgree) {
  EXPECT_FALSE(refine({{1, 1.0}, {2, 2.0}, {4, 4.0}, {8, 4.1}}).agreed);
  EXPECT_FALSE(refine({{1, 1.0}, {2, 2.0}, {4, 4.0}}).checked);
}

TEST(ParetoFront, HoldsWhatNothingBeats) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  //                                       0    1    2    3    4    5
  const std::vector<double> time = {8.0, 1.0, 2.0, 4.0, 1.0, nan};
  const std::vector<double> error = {0.1, 5.0, 2.0, 3.0, 6.0, 0.0};
  EXPECT_EQ(pareto_front(time, error), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_TRUE(pareto_front({}, {}).empty());
}

}  // namespace
}  // namespace weaveform
