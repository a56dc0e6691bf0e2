// Tangent laws: stress and energy are the integrals of the tangent, whatever its pieces.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.hpp"
#include "fabric/law/tangent_law.hpp"

namespace weaveform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Table 2, PW
TangentLaw plain_weave() {
  return TangentLaw({{0.0, 0.0264, {0, 0, 0, 1.07e9}}, {0.0264, infinity, {19800}}});
}

// Three pieces with jumps, and a last one that ends.
TangentLaw three_pieces() {
  return TangentLaw({{0.0, 0.1, {2, -3, 40}}, {0.1, 0.4, {5, 1}}, {0.4, 0.7, {0.5, 0, 2, -1}}});
}

// Composite Simpson on 2000 intervals: exact for cubics, so only rounding remains for the laws above.
double simpson(const std::function<double(double)>& f, double a, double b) {
  constexpr int intervals = 2000;
  const double h = (b - a) / intervals;
  double sum = f(a) + f(b);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(a + i * h);
  return sum * h / 3.0;
}

// The same, piece by piece: the tangent jumps at the joins, where "just below" counts for the piece that ends.
double stress_by_quadrature(const TangentLaw& law, double strain) {
  double sum = 0.0;
  for (const auto& piece : law.pieces()) {
    const double end = std::min(strain, piece.to);
    if (end <= piece.from) break;
    const auto tangent = [&](double e) { return law.tangent(std::min(e, std::nextafter(piece.to, 0.0))); };
    sum += simpson(tangent, piece.from, end);
  }
  return sum;
}

TEST(TangentLaw, StressIsTheIntegralOfTheTangent) {
  for (const double strain : {0.003, 0.02, 0.0264, 0.03, 0.2}) {
    const double expected = stress_by_quadrature(plain_weave(), strain);
    EXPECT_NEAR(plain_weave().stress(strain), expected, 1e-11 * expected) << strain;
  }
  for (const double strain : {0.05, 0.1, 0.25, 0.4, 0.69}) {
    const double expected = stress_by_quadrature(three_pieces(), strain);
    EXPECT_NEAR(three_pieces().stress(strain), expected, 1e-11 * expected) << strain;
  }
}

TEST(TangentLaw, EnergyIsTheIntegralOfTheStress) {
  for (const auto& law : {plain_weave(), three_pieces()}) {
    for (const double strain : {0.01, 0.0264, 0.3, 0.6}) {
      const double expected = simpson([&](double e) { return law.stress(e); }, 0.0, strain);
      // Stress has kinks at the joins, where Simpson errs by about jump h^2 / 12, far below 1e-5 of the energy.
      EXPECT_NEAR(law.energy(strain), expected, 1e-5 * expected) << strain;
    }
  }
}

TEST(TangentLaw, TangentIsTheDerivativeOfTheStress) {
  constexpr double h = 1e-6;  // central difference of a quartic: error h^2 C''/6, 1e-8 of the tangent or less
  const TangentLaw law = three_pieces();
  for (const double strain : {-0.2, 0.05, 0.2, 0.5, 0.9}) {
    const double slope = (law.stress(strain + h) - law.stress(strain - h)) / (2.0 * h);
    EXPECT_NEAR(slope, law.tangent(strain), 1e-7 * std::abs(law.tangent(strain))) << strain;
  }
}

TEST(TangentLaw, StressAndEnergyAreContinuousWhereTheTangentJumps) {
  const TangentLaw law = three_pieces();
  for (const double joint : {0.0, 0.1, 0.4, 0.7}) {
    const double below = std::nextafter(joint, -1.0);
    EXPECT_NEAR(law.stress(below), law.stress(joint), 1e-14) << joint;
    EXPECT_NEAR(law.energy(below), law.energy(joint), 1e-14) << joint;
  }
  EXPECT_GT(std::abs(law.tangent(0.1) - law.tangent(std::nextafter(0.1, 0.0))), 1.0);
}

TEST(TangentLaw, ZeroStrainHasNeitherStressNorEnergy) {
  EXPECT_EQ(plain_weave().stress(0.0), 0.0);
  EXPECT_EQ(plain_weave().energy(0.0), 0.0);
  // Also when the law does not begin at zero.
  const TangentLaw late({{0.2, 0.5, {1, 2}}});
  EXPECT_EQ(late.stress(0.0), 0.0);
  EXPECT_NEAR(late.stress(0.2), 0.2 * 1.4, 1e-15);  // the first tangent, 1 + 2 * 0.2, holds before it
}

TEST(TangentLaw, TableTwoGivesTheStressOfItsFirstPieceInClosedForm) {
  // s = 1.07e9 / 4 e^4 below 0.0264, then 19800 MPa per unit of strain
  const double knee = 1.07e9 / 4.0 * std::pow(0.0264, 4);
  EXPECT_NEAR(plain_weave().stress(0.0264), knee, 1e-12 * knee);
  EXPECT_NEAR(plain_weave().stress(0.0364), knee + 198.0, 1e-12 * 198.0);
}

TEST(TangentLaw, TangentKeepsItsEndValuesOutside) {
  EXPECT_EQ(three_pieces().tangent(-1.0), 2.0);
  EXPECT_DOUBLE_EQ(three_pieces().tangent(3.0), 0.5 + 2 * 0.49 - 0.343);
}

TEST(TangentLaw, StiffestSeesBothSidesOfAJoinAndTurningPoints) {
  // Just below the join the first piece has 1.07e9 * 0.0264^3 = 19687.6 MPa.
  EXPECT_NEAR(plain_weave().stiffest(0.0, 0.0264), 19800.0, 1e-9);
  EXPECT_NEAR(plain_weave().stiffest(0.0, 0.02), 1.07e9 * 8e-6, 1e-6);
  const TangentLaw hump({{0.0, 1.0, {1, 4, -4}}});
  EXPECT_NEAR(hump.stiffest(0.0, 1.0), 2.0, 1e-14);
  EXPECT_NEAR(hump.stiffest(0.8, 1.0), 1.0 + 4 * 0.16, 1e-14);
  EXPECT_EQ(TangentLaw({{0.0, infinity, {0, 1}}}).stiffest(0.0, infinity), infinity);
}

TEST(TangentLaw, NegativeRangeNamesTheStrainsAndTheLeastTangent) {
  const TangentLaw dip({{0.0, infinity, {0.03, -0.4, 1}}});  // (e - 0.1)(e - 0.3), least -0.01 at 0.2
  EXPECT_EQ(dip.negative_range(0.0, 1.0), "e in [0.1, 0.3]: least tangent -0.01 MPa at 0.2");
  EXPECT_EQ(dip.negative_range(0.0, 0.09), "");
  EXPECT_EQ(plain_weave().negative_range(0.0, 1.0), "");
}

TEST(TangentLaw, PiecesThatDoNotAdjoinAreRefused) {
  EXPECT_THROW(TangentLaw(std::vector<TangentPiece>{}), InputError);
  EXPECT_THROW(TangentLaw({{0.0, 0.1, {1}}, {0.2, 0.3, {1}}}), InputError);       // gap
  EXPECT_THROW(TangentLaw({{0.0, 0.2, {1}}, {0.1, 0.3, {1}}}), InputError);       // overlap
  EXPECT_THROW(TangentLaw({{0.1, 0.1, {1}}}), InputError);                        // empty piece
  EXPECT_THROW(TangentLaw({{0.0, infinity, {1}}, {0.1, 0.3, {1}}}), InputError);  // no end in the middle
  EXPECT_THROW(TangentLaw({{0.0, 1.0, {}}}), InputError);
  EXPECT_THROW(TangentLaw({{0.0, 1.0, {std::nan("")}}}), InputError);
}

}  // namespace
}  // namespace weaveform
