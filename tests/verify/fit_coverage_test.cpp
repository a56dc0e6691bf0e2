// Confidence bands cover the truth as often as they say, over many seeds: the noise is alike within a specimen and
// differs between specimens, as in real tests.
#include <gtest/gtest.h>

#include <cmath>

#include "core/vector/angle.hpp"
#include "fabric/identify/shear_fit.hpp"
#include "fabric/identify/tension_fit.hpp"
#include "tests/support/fit_folder.hpp"

namespace weaveform::identify {
namespace {

constexpr int seeds = 400;
constexpr double confidence = 0.95;
// Two standard deviations of a share of 95 % counted over 400 seeds are 2.2 %; three, 3.3 %.
constexpr double least_share = confidence - 0.033;

struct Noise {
  double factor = 0.1;       // 1; between specimens, of the whole curve
  double reading = 0.002;    // MPa; within a specimen
  double correlation = 0.9;  // of neighbouring readings
};

ShearSpecimen noisy_specimen(const ShearCurve& truth, const Noise& noise, std::mt19937& random) {
  ShearSpecimen specimen;
  std::normal_distribution<double> normal;
  const double factor = 1.0 + noise.factor * normal(random);
  const auto readings = test::correlated_noise(random, 50, noise.correlation);
  for (int i = 1; i <= 50; ++i) {
    const double angle = i * degree;
    const double stress = factor * stress_of(truth, log_shear_strain(angle)) + noise.reading * readings[i - 1];
    specimen.grid.push_back({angle, 1.0, 0.0, stress});
  }
  return specimen;
}

struct Coverage {
  std::vector<double> at_angle;  // share of seeds, for each angle of the grid
  double whole = 0.0;            // share of seeds in which the whole curve lies in its band
};

Coverage coverage_of(const ShearCurve& truth, const Noise& noise, int specimens, FormAsked form) {
  Coverage coverage{std::vector<double>(50, 0.0), 0.0};
  for (int seed = 0; seed < seeds; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::vector<ShearSpecimen> all;
    for (int k = 0; k < specimens; ++k) all.push_back(noisy_specimen(truth, noise, random));
    const ShearFit fit = fit_shear(all, 4, form, confidence);
    bool whole = true;
    for (std::size_t i = 0; i < fit.law.size(); ++i) {
      const double error = std::abs(fit.law[i].stress - stress_of(truth, fit.law[i].strain));
      coverage.at_angle[i] += error <= fit.law[i].half_band ? 1.0 / seeds : 0.0;
      whole = whole && error <= fit.law[i].half_whole;
    }
    coverage.whole += whole ? 1.0 / seeds : 0.0;
  }
  return coverage;
}

// Table 3, PW, integrated.
const ShearCurve plain_weave{{0.0, 0.264, -0.533, 0.313, 0.42}, {}};

class ShearBand : public testing::TestWithParam<int> {};

TEST_P(ShearBand, CoversTheTruthAtEveryAngleAndAsAWhole) {
  const Coverage coverage = coverage_of(plain_weave, {}, GetParam(), FormAsked::polynomial);
  for (std::size_t i = 0; i < coverage.at_angle.size(); ++i)
    EXPECT_GE(coverage.at_angle[i], least_share) << i + 1 << " deg";
  EXPECT_GE(coverage.whole, least_share);
}

INSTANTIATE_TEST_SUITE_P(Specimens, ShearBand, testing::Values(3, 5));

class ShearBandOfOne : public testing::TestWithParam<double> {};

TEST_P(ShearBandOfOne, CoversThatSpecimensOwnLaw) {
  Noise noise;
  noise.factor = 0.0;  // nothing a single specimen could tell
  noise.correlation = GetParam();
  const Coverage coverage = coverage_of(plain_weave, noise, 1, FormAsked::polynomial);
  double mean = 0.0;
  for (const double share : coverage.at_angle) mean += share / 50.0;
  EXPECT_GE(mean, least_share);
}

INSTANTIATE_TEST_SUITE_P(Correlations, ShearBandOfOne, testing::Values(0.0, 0.5, 0.8));

TEST(ShearBand, IsNotFarWiderThanNeeded) {
  const Coverage coverage = coverage_of(plain_weave, {}, 5, FormAsked::polynomial);
  // Student's t is exact for normal scatter: 95 % is meant, not 100 %.
  double mean = 0.0;
  for (const double share : coverage.at_angle) mean += share / 50.0;
  EXPECT_LE(mean, confidence + 0.033);
}

TEST(ModulusInterval, CoversTheTruthForAFewSpecimensAndForOne) {
  const test::FitFolder folder;
  constexpr double modulus = 20000.0;  // MPa
  for (const int specimens : {1, 3, 5}) {
    double covered = 0.0;
    for (int seed = 0; seed < seeds; ++seed) {
      std::mt19937 random(static_cast<unsigned>(seed));
      std::normal_distribution<double> normal;
      TestSpec test;
      test.name = "yarn";
      test.strain_column = "x";
      test.stress_column = "y";
      test.stress = StressKind::nominal;
      test.elastic_range = {0.001, 0.018};
      for (int k = 0; k < specimens; ++k) {
        const double own = modulus * (1.0 + (specimens > 1 ? 0.03 * normal(random) : 0.0));
        const auto strain = test::evenly(0.0, 0.02, 60);
        const auto readings = test::correlated_noise(random, strain.size(), 0.5);
        std::vector<double> stress;
        for (std::size_t i = 0; i < strain.size(); ++i) stress.push_back(own * strain[i] + 2.0 * readings[i]);
        const std::string name = fmt::format("{}.csv", k);
        folder.write_curve(name, strain, stress);
        test.files.push_back(name);
      }
      const YarnFit fit = fit_yarn(test, folder.path() / "fit.toml", 1.25, confidence);
      covered += fit.band[0] <= modulus && modulus <= fit.band[1] ? 1.0 / seeds : 0.0;
    }
    EXPECT_GE(covered, specimens > 1 ? least_share : 0.90) << specimens << " specimens";
  }
}

}  // namespace
}  // namespace weaveform::identify
