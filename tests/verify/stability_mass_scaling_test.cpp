// Mass scaling is loading faster by another name: without weight, a fabric of m times the mass, loaded in the time T,
// goes the same way as the real one in T/sqrt(m), step by step, since steps grow with sqrt(m). So its border is that of
// the loading speed, at m = (T/T_border)^2.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "tests/support/ask_border.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double slowness = 3.0;  // sqrt(m)

Scene coarse(const std::string& name, const std::string& coarsening, double duration, double mass) {
  Scene scene = example(name, {"blank.coarsening=" + coarsening});
  scene.analysis.duration = duration;
  scene.analysis.mass_scale = mass;
  return scene;
}

// Forces row by row, relative to the greatest.
void expect_same_forces(const Solved& heavy, const Solved& fast, const std::string& column) {
  const auto a = heavy.result.history.values(column), b = fast.result.history.values(column);
  ASSERT_EQ(a.size(), b.size());
  double greatest = 0.0;
  for (const double force : b) greatest = std::max(greatest, std::abs(force));
  ASSERT_GT(greatest, 1.0);
  // rounding, grown by slack yarns that choose a side to give way
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-6 * greatest) << column << " row " << k;
}

TEST(MassScaling, IsTheSameAsLoadingFasterInABiasExtension) {
  const double duration = 0.3;
  const Solved heavy(coarse("bias_extension_pw", "4", duration, slowness * slowness));
  const Solved fast(coarse("bias_extension_pw", "4", duration / slowness, 1.0));
  EXPECT_LE(std::abs(heavy.result.statistics.steps - fast.result.statistics.steps), 2);
  expect_same_forces(heavy, fast, "top.force_N");
  expect_same_forces(heavy, fast, "bottom.force_N");
}

TEST(MassScaling, IsTheSameAsLoadingFasterInADrawing) {
  const double duration = 0.4;
  Scene quick = coarse("hemisphere_pw", "8", duration / slowness, 1.0);
  for (auto& tool : quick.tools) tool.damping *= slowness;  // 1/s, of the binder's guide: a rate, like 1/duration
  const Solved heavy(coarse("hemisphere_pw", "8", duration, slowness * slowness)), fast(quick);
  for (const char* column : {"punch.force_N", "die.force_N", "binder.force_N"}) expect_same_forces(heavy, fast, column);
}

TEST(MassScaling, WarnsBeyondTheFactorThatSimilarityGives) {
  const double border = 0.110, duration = 0.33;  // s; bench/stability/loading_speed_bias.toml, coarsening 4
  const double factor = std::pow(duration / border, 2);
  for (const double side : {1.0 / 1.2, 1.2}) {
    const Solved run(coarse("bias_extension_pw", "4", duration, side * factor));
    EXPECT_EQ(!ask(warn_of_fast_loading, run.scene, run.card, run.mesh, run.result).empty(), side > 1.0) << side;
  }
}

}  // namespace
}  // namespace weaveform
