// Numbers side by side: their roots to the last bits, and element bodies that give each lane what they
// give it alone.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/element/kernel_law.hpp"
#include "solver/element/shear_cell.hpp"
#include "solver/element/yarn.hpp"
#include "solver/element/yarn_law.hpp"

namespace weaveform {
namespace {

double relative_error(double value, long double exact) {
  return static_cast<double>(std::abs((static_cast<long double>(value) - exact) / exact));
}

// 4e-16: two roundings of the last step without fused operations
TEST(InverseRoot, IsRightToTheLastBits) {
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> exponent(-80.0, 80.0);
  for (int n = 0; n < 200000; ++n) {
    const double x = std::exp(exponent(generator));
    EXPECT_LT(relative_error(inverse_root(x), 1.0L / std::sqrt(static_cast<long double>(x))), 4e-16) << x;
  }
  EXPECT_EQ(inverse_root(1.0), 1.0);
}

using SingleLanes = PackOf<parts_of_block, float>;

SingleLanes in_single(const double (&numbers)[lane_count]) {
  return narrow<SingleLanes>(load_lanes(numbers));
}

// 2e-7: two or three roundings of 6e-8
TEST(SinglePrecision, InverseRootIsRightToTheLastBits) {
  std::mt19937_64 generator(12);
  std::uniform_real_distribution<double> exponent(-40.0, 40.0);
  for (int n = 0; n < 20000; ++n) {
    double x[lane_count];
    for (double& one : x) one = static_cast<float>(std::exp(exponent(generator)));
    const SingleLanes root = inverse_root(in_single(x));
    for (int l = 0; l < lane_count; ++l)
      EXPECT_LT(relative_error(root[l], 1.0L / std::sqrt(static_cast<long double>(x[l]))), 2e-7) << x[l];
  }
}

TEST(SinglePrecision, LogarithmIsRightToTheLastBits) {
  std::mt19937_64 generator(13);
  std::uniform_real_distribution<double> exponent(-3.0, 3.0), around(-0.5, 0.5);
  for (int n = 0; n < 20000; ++n) {
    double a[lane_count], b[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      b[l] = static_cast<float>(std::exp(exponent(generator)));
      a[l] = static_cast<float>(b[l] * std::exp(l % 2 == 0 ? around(generator) : exponent(generator)));
    }
    const SingleLanes logarithm = half_log(in_single(a), in_single(b));
    for (int l = 0; l < lane_count; ++l) {
      const long double exact = 0.5L * std::log(static_cast<long double>(a[l]) / b[l]);
      EXPECT_LE(std::abs(logarithm[l] - exact), 3e-7L * std::abs(exact)) << a[l] << " over " << b[l];
    }
  }
}

// The strain of a yarn hangs on the difference of two squares that are nearly the same: given exactly, a strain of 1e-6
// is as right as one of 0.1.
TEST(SinglePrecision, SmallStrainsLoseNoDigits) {
  for (double strain = 0.2; strain > 1e-7; strain /= 3.0) {
    double square[lane_count], rest_square[lane_count], excess[lane_count];
    for (int l = 0; l < lane_count; ++l) {
      const double rest = 1.0 + 0.37 * l;
      rest_square[l] = rest * rest;
      square[l] = rest_square[l] * std::exp(2.0 * (l % 2 == 0 ? strain : -strain));
      excess[l] = rest_square[l] * std::expm1(2.0 * (l % 2 == 0 ? strain : -strain));
    }
    const auto parts = half_log_parts(in_single(square), in_single(rest_square), in_single(excess));
    const SingleLanes found = parts.value(parts.numerator / parts.denominator);
    for (int l = 0; l < lane_count; ++l) EXPECT_NEAR(found[l], l % 2 == 0 ? strain : -strain, 3e-7 * strain);
  }
}

TEST(InverseRoot, OfWhatIsNoNumberIsNone) {
  EXPECT_TRUE(std::isnan(inverse_root(std::nan(""))));
}

template <Section section>
void expect_yarns_alike(const PaperLaw& law, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> strain(-0.3, 0.3);
  const double rest = 4.92, area = 1.3;
  double square[lane_count], excess[lane_count], together[lane_count], inverses[lane_count];
  for (int l = 0; l < lane_count; ++l) {
    square[l] = std::pow(rest * std::exp(strain(generator)), 2);
    excess[l] = square[l] - rest * rest;
  }
  Lanes inverse;
  store_lanes(together, yarn_force_per_length<section>(law, load_lanes(square), load_lanes(excess), spread<Lanes>(rest),
                                                       spread<Lanes>(area), inverse));
  store_lanes(inverses, inverse);
  for (int l = 0; l < lane_count; ++l) {
    double inverse_alone = 0.0;
    EXPECT_EQ(together[l], yarn_force_per_length<section>(law, square[l], excess[l], rest, area, inverse_alone));
    EXPECT_EQ(inverses[l], inverse_alone);
    EXPECT_NEAR(inverse_alone * square[l], 1.0, 1e-15);
  }
}

TEST(Lanes, YarnsHaveTheForceTheyHaveAlone) {
  PaperLaw law;
  ASSERT_TRUE(pack_law(yarn_laws(load_card("twintex-pw"), ModelSpec{})[0], law));
  std::mt19937_64 generator(3);
  for (int n = 0; n < 200; ++n) {
    expect_yarns_alike<Section::incompressible>(law, generator);
    expect_yarns_alike<Section::constant>(law, generator);
  }
}

// Whatever loop a yarn comes to: near its length at rest both have its bits.
template <Section section>
void expect_near_as_any(const PaperLaw& law, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> ratio(least_near_ratio, greatest_near_ratio);
  const double rest = 4.92, square = rest * rest * ratio(generator), excess = square - rest * rest;
  double near_inverse = 0.0, inverse = 0.0;
  const double near_force = yarn_force_per_length<section, true>(law, square, excess, rest, 1.3, near_inverse);
  EXPECT_EQ(near_force, (yarn_force_per_length<section, false>(law, square, excess, rest, 1.3, inverse))) << square;
  EXPECT_EQ(near_inverse, inverse);
}

TEST(Lanes, YarnsNearTheirLengthAtRestHaveTheBitsOfAny) {
  PaperLaw law;
  ASSERT_TRUE(pack_law(yarn_laws(load_card("twintex-pw"), ModelSpec{})[0], law));
  std::mt19937_64 generator(5);
  for (int n = 0; n < 20000; ++n) {
    expect_near_as_any<Section::incompressible>(law, generator);
    expect_near_as_any<Section::constant>(law, generator);
  }
}

template <Formulation formulation, Thickness thickness, class Shear>
void expect_cells_alike(const Shear& shear, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> draw(-0.8, 0.8);
  double component[6][lane_count];
  Lanes g1[3], g2[3];
  for (int l = 0; l < lane_count; ++l)
    for (int c = 0; c < 6; ++c) component[c][l] = draw(generator) + (c == 0 || c == 4 ? 1.0 : 0.0);
  for (int c = 0; c < 3; ++c) {
    g1[c] = load_lanes(component[c]);
    g2[c] = load_lanes(component[3 + c]);
  }
  Lanes squares;
  const auto together = shear_cell_force<formulation, thickness>(shear, g1, g2, spread<Lanes>(3.0), squares);
  for (int l = 0; l < lane_count; ++l) {
    const double w1[3] = {component[0][l], component[1][l], component[2][l]};
    const double w2[3] = {component[3][l], component[4][l], component[5][l]};
    double square = 0.0;
    const auto alone = shear_cell_force<formulation, thickness>(shear, w1, w2, 3.0, square);
    EXPECT_EQ(squares[l], square);
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(together.warp[c][l], alone.warp[c]);
      EXPECT_EQ(together.weft[c][l], alone.weft[c]);
    }
  }
}

TEST(Lanes, CellsHaveTheForceTheyHaveAlone) {
  KernelShear<PaperShearLaw> shear;
  const ShearCard card = load_card("twintex-pw").shear;
  ASSERT_TRUE(pack_law(card.tangent, shear.law));
  shear.plateau = 0.01;
  shear.rise = 0.02;
  std::mt19937_64 generator(8);
  for (int n = 0; n < 200; ++n) {
    expect_cells_alike<Formulation::energy, Thickness::constant_volume>(shear, generator);
    expect_cells_alike<Formulation::energy, Thickness::constant>(shear, generator);
    expect_cells_alike<Formulation::contravariant, Thickness::constant>(shear, generator);
  }
}

}  // namespace
}  // namespace weaveform
