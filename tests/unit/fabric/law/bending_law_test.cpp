// Moment-curvature laws of both senses.
#include "fabric/law/bending_law.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace weaveform {
namespace {

constexpr double no_end = std::numeric_limits<double>::infinity();
const TangentLaw yielding_half({{0.0, 0.02, {8.0, -100.0}}, {0.02, no_end, {1.0}}}),
    stiff_half({{0.0, no_end, {12.0}}});

TEST(BendingLaw, EachSenseHasItsOwnMomentAndEnergy) {
  const BendingLaw law(yielding_half, stiff_half);
  EXPECT_FALSE(law.is_odd());
  for (const double curvature : {0.0, 0.005, 0.02, 0.3}) {
    EXPECT_EQ(law.moment(curvature), yielding_half.stress(curvature));
    EXPECT_EQ(law.moment(-curvature), -stiff_half.stress(curvature));
    EXPECT_EQ(law.energy(curvature), yielding_half.energy(curvature));
    EXPECT_EQ(law.energy(-curvature), stiff_half.energy(curvature));
  }
  EXPECT_EQ(law.stiffest(0.3), 12.0);
  EXPECT_EQ(law.first_stiffness(), 10.0);
  EXPECT_DOUBLE_EQ(law.mean_secant(0.02), 0.5 * (yielding_half.stress(0.02) / 0.02 + 12.0));
}

// The moment is the slope of the energy, through zero too, where the stiffness jumps.
TEST(BendingLaw, TheMomentIsTheSlopeOfTheEnergyThroughZero) {
  const BendingLaw law(yielding_half, stiff_half);
  constexpr double h = 1e-6;
  for (int k = -30; k <= 30; ++k) {
    const double at = 1e-3 * k, slope = (law.energy(at + h) - law.energy(at - h)) / (2.0 * h);
    EXPECT_NEAR(slope, law.moment(at), 12.0 * h) << at;  // where it jumps
  }
}

TEST(BendingLaw, TurnedOverItIsTheOtherSensesAndTwiceItself) {
  const BendingLaw law(yielding_half, stiff_half), over = law.turned_over();
  for (const double curvature : {-0.03, -0.01, 0.0, 0.02}) EXPECT_EQ(over.moment(curvature), -law.moment(-curvature));
  EXPECT_EQ(over.turned_over(), law);
  EXPECT_NE(over, law);
}

TEST(BendingLaw, EqualHalvesAreAnOddLaw) {
  EXPECT_EQ(BendingLaw(yielding_half, yielding_half), BendingLaw(yielding_half));
  EXPECT_TRUE(BendingLaw(yielding_half).is_odd());
  EXPECT_TRUE(BendingLaw().is_odd());
  EXPECT_TRUE(BendingLaw().empty());
  EXPECT_FALSE(BendingLaw(yielding_half, stiff_half).empty());
}

TEST(BendingLaw, AConstantBesideItStiffensBothSenses) {
  const BendingLaw law(yielding_half, stiff_half), more = with_constant(law, 3.0);
  for (const double curvature : {-0.03, 0.01})
    EXPECT_NEAR(more.moment(curvature), law.moment(curvature) + 3.0 * curvature, 1e-15);
  EXPECT_TRUE(with_constant(yielding_half, 3.0).is_odd());
}

}  // namespace
}  // namespace weaveform
