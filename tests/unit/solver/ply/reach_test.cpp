// The watch over the strains that the stable step allows for.
#include "solver/ply/reach.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fabric/card/card.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/ply/strain_error.hpp"
#include "tests/support/yarn_chain.hpp"

namespace weaveform {
namespace {

FamilyStrains both(double least, double greatest) {
  return {StrainRange{least, greatest}, StrainRange{least, greatest}};
}

TEST(Reach, FixedIsNeverPassed) {
  Reach reach(true);
  EXPECT_FALSE(reach.passed_by(both(-0.4, 0.4), 0.0));
  EXPECT_FALSE(reach.passed_by(both(-2.0, 2.0), 0.0)) << "torn yarns are another check's";
  reach.renew();
  EXPECT_TRUE(reach.allowed()[0].holds({-torn_strain, torn_strain}));
}

TEST(Reach, IsPassedByTheFirstStrainBeyondInEitherFamilyAndEitherSense) {
  for (const auto& now : {FamilyStrains{StrainRange{0.0, 0.01}, {}}, FamilyStrains{StrainRange{}, {0.0, 0.01}},
                          FamilyStrains{StrainRange{-0.01, 0.0}, {}}, FamilyStrains{StrainRange{}, {-0.01, 0.0}}}) {
    Reach reach(false);
    EXPECT_FALSE(reach.passed_by(both(0.0, 0.0), 0.0));
    EXPECT_TRUE(reach.passed_by(now, 0.0));
    reach.renew();
    EXPECT_FALSE(reach.passed_by(now, 0.0)) << "renewed, the step allows for what was reached";
  }
}

TEST(Reach, AllowsWhatWasReachedSinceTheLastRenewalAndForgetsOlderStrains) {
  Reach reach(false);
  (void)reach.passed_by(both(-0.02, 0.02), 0.0);
  (void)reach.passed_by(both(0.0, 0.005), 0.0);
  reach.renew();
  EXPECT_FALSE(reach.passed_by(both(-0.02, 0.02), 0.0)) << "a greatest of the interval, not of its last step";
  reach.renew();
  EXPECT_FALSE(reach.passed_by(both(0.0, 0.005), 0.0));
  reach.renew();
  EXPECT_TRUE(reach.passed_by(both(0.0, 0.02), 0.0));
}

// A cell that closes: from 27 degrees on every 3 % of the logarithmic strain, so that none stiffens far between two looks.
TEST(Reach, IsPassedByAShearBeyondWhatWasReached) {
  const auto square = [](double log_strain) { return std::pow(std::tanh(log_strain), 2); };
  Reach reach(false), fixed(true);
  EXPECT_FALSE(reach.passed_by({}, square(0.49)));
  EXPECT_TRUE(reach.passed_by({}, square(0.51)));
  reach.renew();
  EXPECT_FALSE(reach.passed_by({}, square(0.51 * 1.02)));
  EXPECT_TRUE(reach.passed_by({}, square(0.51 * 1.04)));
  EXPECT_TRUE(reach.passed_by({}, 1.0)) << "closed";
  reach.renew();
  EXPECT_FALSE(reach.passed_by({}, square(5.0)));
  EXPECT_FALSE(fixed.passed_by({}, 1.0));
}

TEST(Reach, ACheckpointKeepsIt) {
  Reach reach(false), resumed(false);
  (void)reach.passed_by(both(-0.01, 0.03), 0.0);
  const std::string kept = state_bytes(reach);
  StateReader reader(kept);
  resumed.archive(reader);
  reach.renew();
  resumed.renew();
  EXPECT_EQ(resumed.allowed()[1].greatest, reach.allowed()[1].greatest);
  EXPECT_EQ(resumed.allowed()[0].least, reach.allowed()[0].least);
}

// The card's law is cubic below its joint: s = c e^4/4. With a scale f on it, f e^4 exp(-e) = e'^4 exp(-e').
TEST(YarnStrainError, IsThatOfTheQuarticStress) {
  const Card card = load_card("twintex-pw");
  Mesh mesh = test::chain_mesh(1, 5.0, 1.25, 1e-9);
  ModelSpec model;
  model.yarn_stiffness_scale = 0.25;
  const double strain = 0.016, real = strain * std::pow(0.25, 0.25);
  // exp(-e) against exp(-e') moves e' by a quarter of (e - e'): below 0.2 % of it here
  EXPECT_NEAR(yarn_strain_error(mesh, card, model, {strain}), strain - real, 0.003 * real);
  EXPECT_EQ(yarn_strain_error(mesh, card, model, {-0.01}), 0.0) << "no force that matters in a slack yarn";
  model.yarn_stiffness_scale = 1.0;
  EXPECT_EQ(yarn_strain_error(mesh, card, model, {strain}), 0.0);
}

}  // namespace
}  // namespace weaveform
