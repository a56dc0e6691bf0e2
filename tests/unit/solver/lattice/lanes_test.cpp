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

TEST(InverseRoot, OfWhatIsNoNumberIsNone) {
  EXPECT_TRUE(std::isnan(inverse_root(std::nan(""))));
}

template <Section section>
void expect_yarns_alike(const PaperLaw& law, std::mt19937_64& generator) {
  std::uniform_real_distribution<double> strain(-0.3, 0.3);
  const double rest = 4.92, area = 1.3;
  double square[lane_count], together[lane_count], inverses[lane_count];
  for (double& s : square) s = std::pow(rest * std::exp(strain(generator)), 2);
  Lanes inverse;
  store_lanes(together, yarn_force_per_length<section>(law, load_lanes(square), spread<Lanes>(rest),
                                                       spread<Lanes>(area), inverse));
  store_lanes(inverses, inverse);
  for (int l = 0; l < lane_count; ++l) {
    double inverse_alone = 0.0;
    EXPECT_EQ(together[l], yarn_force_per_length<section>(law, square[l], rest, area, inverse_alone));
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
