// Tension laws of yarns: the paper's decrimping construction, the elastic part of a curve.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "fabric/card/card.hpp"
#include "fabric/identify/decrimping.hpp"
#include "fabric/identify/tension_fit.hpp"

namespace weaveform::identify {
namespace {

TEST(DecrimpingLaw, IsTable2ToItsPrintedFigures) {
  for (const std::string name : {"twintex-pw", "twintex-tw"}) {
    for (const YarnCard& yarn : load_card(name).yarn) {
      const auto law = decrimping_law(yarn.linear_modulus, yarn.crimp);
      const auto& printed = yarn.tension.pieces();
      ASSERT_EQ(law.size(), 2u);
      EXPECT_NEAR(law[0].to, printed[0].to, 1e-4) << name;
      EXPECT_NEAR(law[0].coefficient[3] / printed[0].coefficient[3], 1.0, 0.01) << name;
    }
  }
}

TEST(DecrimpingLaw, JoinsTheLineOfTheStraightYarnInValueAndSlope) {
  for (const double crimp : {0.001, 0.02, 0.2}) {
    const TangentLaw law(decrimping_law(20000.0, crimp));
    const double joint = law.pieces()[0].to, straight = std::log1p(crimp);
    EXPECT_NEAR(law.stress(joint), 20000.0 * (joint - straight), 1e-9 * law.stress(joint));
    EXPECT_NEAR(law.tangent(joint * (1.0 - 1e-9)), 20000.0, 1e-3);
  }
}

TEST(DecrimpingLaw, WithoutCrimpIsLinear) {
  const TangentLaw law(decrimping_law(20000.0, 0.0));
  EXPECT_EQ(law.stress(0.01), 200.0);
}

// A toe of a parabola, a straight part from 20 to 80 % of the greatest stress, a bend above.
TEST(ElasticPart, LiesWithinTheStraightPart) {
  std::vector<double> strain, stress;
  for (int i = 0; i <= 500; ++i) {
    const double e = 2e-5 * i;  // to 1 %
    const double toe = 0.004, bend = 0.008;
    double s = 1e4 * (e - 0.5 * toe);
    if (e < toe) s = 1e4 * e * e / (2.0 * toe);
    if (e > bend) s -= 2e6 * (e - bend) * (e - bend);
    strain.push_back(e);
    stress.push_back(s);
  }
  const auto [from, to] = elastic_part(strain, stress, "yarn");
  // The 1 % of bow allowed lets the ends reach a little into the curves.
  EXPECT_GT(from, 0.0025);
  EXPECT_LT(to, 0.0088);
  EXPECT_GT(to - from, 0.003);
}

TEST(ElasticPart, ACurveWithoutOneIsRefused) {
  std::vector<double> strain, stress;
  for (int i = 0; i <= 100; ++i) {
    strain.push_back(1e-4 * i);
    stress.push_back(std::expm1(0.1 * i));
  }
  EXPECT_THROW((void)elastic_part(strain, stress, "yarn"), InputError);
}

}  // namespace
}  // namespace weaveform::identify
