// Moment-curvature curves: shape, knots, friction along a record.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fabric/identify/bending_curve.hpp"
#include "fabric/identify/unit.hpp"

namespace weaveform::identify {
namespace {

const BendingCurve yielding{{0.0, 0.002, 0.0025, 0.02}, {120.0, 118.0, 12.0, 3.0}};

TEST(BendingCurve, IsOddAndTheIntegralOfItsTangent) {
  for (const double at : {1e-4, 0.0019, 0.0022, 0.0031, 0.019, 0.05}) {
    EXPECT_EQ(yielding.moment(-at), -yielding.moment(at));
    const double step = 1e-7;
    EXPECT_NEAR((yielding.moment(at + step) - yielding.moment(at - step)) / (2.0 * step), yielding.tangent_at(at),
                1e-5 * 120.0);
    EXPECT_NEAR(yielding.curvature(yielding.moment(at)), at, 1e-12);
  }
}

TEST(BendingCurve, AsALawOfAYarnIsTheSameTimesTheInterval) {
  constexpr double interval = 4.92;
  const TangentLaw law(pieces_of(yielding, interval));
  for (const double at : {0.0, 1e-4, 0.0019, 0.00249, 0.0026, 0.019, 0.05}) {
    EXPECT_NEAR(law.stress(at), interval * yielding.moment(at), 1e-8 * interval);
    EXPECT_GT(law.tangent(at), 0.0);
  }
}

// Readings without noise: the misfit asked for is reached, with no more pieces than allowed.
TEST(BendingCurve, FollowsReadingsAsCloselyAsAsked) {
  std::vector<BendingReading> readings;
  for (int i = 0; i <= 300; ++i) {
    const double at = 0.02 * i / 300;
    readings.push_back({at, yielding.moment(at), 0.0});
  }
  const auto fit = fit_bending_curve(readings, {.pieces = 14});
  EXPECT_LE(fit.curve.knot.size(), 14U);
  EXPECT_LT(fit.misfit, 5e-4 * yielding.moment(0.02));
  for (const double tangent : fit.curve.tangent) EXPECT_GT(tangent, 0.0);
}

// Noise alone buys no pieces: what is found of a straight line with noise of 1 % is straight.
TEST(BendingCurve, NoiseBuysNoPieces) {
  int pieces = 0;
  for (unsigned seed = 0; seed < 10; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<BendingReading> readings;
    for (int i = 1; i <= 200; ++i) {
      const double at = 0.02 * i / 200;
      readings.push_back({at, 50.0 * at + 0.01 * normal(random), 0.0});
    }
    const auto fit = fit_bending_curve(readings, {});
    pieces += static_cast<int>(fit.curve.knot.size());
    EXPECT_NEAR(fit.curve.moment(0.01), 0.5, 0.01);
  }
  EXPECT_LE(pieces, 25) << "two knots are the fewest";
}

// phi after a reversal: 1 - 2 exp(-way/rise), whatever steps the record has.
TEST(FrictionShare, BranchesAreExponentialsWhateverTheSteps) {
  constexpr double rise = 0.001;
  for (const int steps : {3, 50}) {
    std::vector<double> record;
    for (int i = 0; i <= steps; ++i) record.push_back(0.02 * i / steps);
    for (int i = 1; i <= steps; ++i) record.push_back(0.02 - 0.002 * i / steps);
    const auto share = friction_share(record, rise, 0.0);
    EXPECT_NEAR(share[1], 1.0 - std::exp(-record[1] / rise), 1e-12);
    EXPECT_NEAR(share[steps], 1.0, 3e-9);
    EXPECT_NEAR(share.back(), -1.0 + 2.0 * std::exp(-2.0), 3e-9);
  }
}

TEST(BendingUnits, AreFoundInHeadingsHoweverTheyAreMultiplied) {
  for (const std::string heading : {"M [gf.cm/cm]", "M (gf*cm/cm)", "M (gf cm/cm)",
                                    "M [gf\xc2\xb7"
                                    "cm/cm]"})
    EXPECT_EQ(unit_in(heading, Quantity::moment_per_length), "gf cm/cm") << heading;
  EXPECT_EQ(unit_in("moment_N_mm_per_mm", Quantity::moment_per_length), "N mm/mm");
  EXPECT_EQ(unit_in("K (1/cm)", Quantity::curvature), "1/cm");
  EXPECT_NEAR(unit_factor(Quantity::moment_per_length, "gf cm/cm"), 9.80665e-3, 1e-12);  // N
}

}  // namespace
}  // namespace weaveform::identify
