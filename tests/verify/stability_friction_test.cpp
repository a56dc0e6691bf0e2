// Friction. Stick is exact at any coefficient; what ends is the tension that a node bears on an edge, exp(mu phi) times
// that of the flange: with chords of length h it sinks in by some e h^2/(R s) (solver/contact/contact.hpp), so that a
// finer mesh bears more.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/support/belt.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

using namespace test;

// bench/stability/friction.toml, hemisphere at coarsening 8
constexpr double greatest_mu = 0.587;

SolveResult drawn(double coarsening, double friction) {
  Scene scene = example("hemisphere_pw", {late_punch});
  scene.blank.coarsening = {coarsening, coarsening};
  for (auto& tool : scene.tools) tool.friction = friction;
  scene.analysis.duration = 0.2;
  return Solved(scene).result;
}

TEST(Friction, BeyondWhatNodesBearTheRunStops) {
  EXPECT_LT(drawn(8.0, greatest_mu / 1.2).statistics.energy_error, 0.01);
  try {
    (void)drawn(8.0, greatest_mu * 1.2);
    FAIL() << "not stopped";
  } catch (const PhysicsError& error) {
    EXPECT_NE(std::string(error.what()).find("more than the fabric's thickness"), std::string::npos) << error.what();
  }
  EXPECT_LT(drawn(4.0, greatest_mu * 1.2).statistics.energy_error, 0.01);  // the same friction on a finer mesh
}

// At the greatest coefficient a scene may have a belt does not slide: its held end feels nothing, while the pulled one
// stretches what is free of the cylinder.
TEST(Friction, TheGreatestCoefficientSticks) {
  Belt belt = make_belt({}, 10.0);
  belt.scene.grip[0].travel = 0.0;
  belt.scene.grip[1].travel = 1.5;
  const SolveResult result = belt.run();
  const double pulled = result.history.values("pulled.force_N").back();
  EXPECT_GT(pulled, 1.0);
  EXPECT_LT(std::abs(result.history.values("held.force_N").back()), 1e-3 * pulled);
  EXPECT_LT(result.statistics.energy_error, 0.01);
}

}  // namespace
}  // namespace weaveform
