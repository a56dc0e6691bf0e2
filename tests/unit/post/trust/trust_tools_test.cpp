// What the warnings about speed and pushed tools are told from: histories made up so that the answer is known.
#include <gtest/gtest.h>

#include <cmath>

#include "post/trust/inertia.hpp"
#include "post/trust/pushed_tools.hpp"

namespace weaveform {
namespace {

constexpr int rows = 200;

GripSpec moved(const std::string& name, double travel) {
  GripSpec grip;
  grip.name = name;
  grip.travel = travel;
  return grip;
}

// A spring of 2 N/mm with a mass that follows the grip, pulled 10 mm at a speed that grows with time: the inertia is
// the mass times the constant acceleration, the whole load 20 N and that.
History pulled(double mass, double duration) {
  History history{{"time_s", "pull.displacement_mm", "pull.force_N", "kinetic_energy_mJ"}, {}};
  const double acceleration = 2.0 * 10.0 / (duration * duration);
  for (int n = 0; n <= rows; ++n) {
    const double t = duration * n / rows, v = acceleration * t, x = 0.5 * acceleration * t * t;
    history.row.push_back({t, x, 2.0 * x + mass * acceleration, 0.5 * mass * v * v});
  }
  return history;
}

TEST(InertiaShare, IsTheForceThatMassTakes) {
  Scene scene;
  scene.grip = {moved("pull", 10.0)};
  const double mass = 1e-3, acceleration = 20.0 / (0.1 * 0.1), force = mass * acceleration;
  const InertiaShare share = inertia_share(scene, pulled(mass, 0.1), 0.0);
  EXPECT_NEAR(share.share, force / (20.0 + force), 1e-9);
  EXPECT_GE(share.from, 0.0);
  EXPECT_LE(share.to, 0.1);
}

TEST(InertiaShare, CountsWhatMassProportionalDampingTakes) {
  Scene scene;
  scene.grip = {moved("pull", 10.0)};
  const double mass = 1e-3, damping = 300.0, duration = 0.1, acceleration = 20.0 / (duration * duration);
  // alpha m v is greatest at the end; its mean over the last twentieth of the way
  const double v = acceleration * duration, from = duration * std::sqrt(0.95);
  const double lost = damping * mass * acceleration * acceleration * (std::pow(duration, 3) - std::pow(from, 3)) / 3.0;
  const double force = mass * acceleration, expected = (force + lost / 0.5) / (20.0 + force);
  EXPECT_NEAR(inertia_share(scene, pulled(mass, duration), damping).share, expected, 0.01 * expected) << v;
}

TEST(InertiaShare, SaysNothingWhereSomethingElseMovesTheFabric) {
  Scene scene;
  scene.grip = {moved("pull", 10.0)};
  scene.analysis.gravity = {0.0, 0.0, -9810.0};
  EXPECT_EQ(inertia_share(scene, pulled(1e-3, 0.1), 0.0).share, 0.0);
  scene.analysis.gravity = {0.0, 0.0, 0.0};
  EXPECT_EQ(inertia_share(scene, {pulled(1e-3, 0.1).column, {}}, 0.0).share, 0.0);
}

// A binder that gives 100 N but for one dip, while it moves by 1 mm/s.
History pressed(double dip_at, double dip) {
  History history{{"time_s", "binder.displacement_mm", "binder.force_N"}, {}};
  for (int n = 0; n <= rows; ++n) {
    const double part = static_cast<double>(n) / rows;
    history.row.push_back({part, part, n == std::lround(dip_at * rows) ? 100.0 - dip : 100.0});
  }
  return history;
}

Scene binder_scene(double travel) {
  Scene scene;
  ToolSpec binder;
  binder.name = "binder";
  binder.force = 100.0;
  binder.damping = 1000.0;
  scene.tools = {binder};
  scene.grip = {moved("pull", travel)};
  return scene;
}

TEST(PushedTools, FindTheWorstMomentAfterTheForceHasComeOn) {
  const auto found = pushed_tools(binder_scene(1.0), pressed(0.5, 7.0), 2e-3, 0.01);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].off, 0.07, 1e-12);
  EXPECT_NEAR(found[0].time, 0.5, 1e-12);
  EXPECT_NEAR(found[0].felt, 93.0, 1e-12);
  EXPECT_NEAR(found[0].viscous, 2.0, 1e-9);             // 1000 /s * 2e-3 t * 1 mm/s
  EXPECT_NEAR(found[0].share_off, 1.0 / 188.0, 1e-12);  // rows after 6 % of the duration
  EXPECT_EQ(found[0].share_free, 0.0);
  EXPECT_EQ(pushed_tools(binder_scene(1.0), pressed(0.03, 70.0), 2e-3, 0.01)[0].off, 0.0);  // still coming on
  EXPECT_GT(pushed_tools(binder_scene(1.0), pressed(0.5, 99.5), 2e-3, 0.01)[0].share_free, 0.0);
}

TEST(PushedTools, AloneMustOnlyHaveComeToRest) {
  EXPECT_EQ(pushed_tools(binder_scene(0.0), pressed(0.5, 50.0), 2e-3, 0.01)[0].off, 0.0);
  EXPECT_NEAR(pushed_tools(binder_scene(0.0), pressed(1.0, 50.0), 2e-3, 0.01)[0].off, 0.5, 1e-12);
}

}  // namespace
}  // namespace weaveform
