// Polynomials: roots and ranges against products of known factors.
#include "fabric/law/polynomial.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace weaveform {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

// (x - 1)(x + 2)(x - 0.25)
Polynomial three_roots() {
  return product_of(product_of({-1, 1}, {2, 1}), {-0.25, 1});
}

TEST(Polynomial, SignChangesAreTheRootsOfItsFactors) {
  const auto roots = sign_changes(three_roots(), -unbounded, unbounded);
  ASSERT_EQ(roots.size(), 3U);
  // Coefficients and roots are a few units large: some units of the last place.
  EXPECT_NEAR(roots[0], -2.0, 1e-14);
  EXPECT_NEAR(roots[1], 0.25, 1e-14);
  EXPECT_NEAR(roots[2], 1.0, 1e-14);
}

TEST(Polynomial, SignChangesKeepToTheInterval) {
  const auto roots = sign_changes(three_roots(), 0.0, 0.5);
  ASSERT_EQ(roots.size(), 1U);
  EXPECT_NEAR(roots[0], 0.25, 1e-14);
  EXPECT_TRUE(sign_changes(three_roots(), 0.3, 0.9).empty());
}

TEST(Polynomial, ADoubleRootIsNoSignChangeAndNotNegative) {
  const Polynomial touching = product_of({-0.3, 1}, {-0.3, 1});
  EXPECT_TRUE(negative_intervals(touching, 0.0, 1.0).empty());
  EXPECT_NEAR(range_of(touching, 0.0, 1.0)[0], 0.0, 1e-15);
}

TEST(Polynomial, RangeFindsTurningPointsInside) {
  // 4 x (1 - x): 1 at the middle, 0 at the ends
  const Interval range = range_of({0, 4, -4}, 0.0, 1.0);
  EXPECT_NEAR(range[0], 0.0, 1e-15);
  EXPECT_NEAR(range[1], 1.0, 1e-15);
}

TEST(Polynomial, RangeIsUnboundedWhereThePolynomialIs) {
  EXPECT_EQ(range_of({1, 0, 2}, 0.0, unbounded)[1], unbounded);
  EXPECT_EQ(range_of({1, 0, 0, 2}, -unbounded, 0.0)[0], -unbounded);
  EXPECT_EQ(range_of({3}, -unbounded, unbounded)[1], 3.0);
}

TEST(Polynomial, NegativeIntervalsLieBetweenRoots) {
  const auto parts = negative_intervals(three_roots(), -1.0, 2.0);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_NEAR(parts[0][0], 0.25, 1e-14);
  EXPECT_NEAR(parts[0][1], 1.0, 1e-14);
}

TEST(Polynomial, IntegralUndoesDerivative) {
  const Polynomial p = {0, 3, -2, 5};
  EXPECT_EQ(integral_of(derivative_of(p)), p);
}

}  // namespace
}  // namespace weaveform
