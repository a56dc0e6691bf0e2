// Coulomb friction against known answers: a block on an incline, a belt over a cylinder, a strip between plates.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "tests/support/belt.hpp"
#include "tests/support/contact_scene.hpp"

namespace weaveform {
namespace {

using namespace test;

// A square of fabric on a plane, its weight leaning by `slope` = tan(angle).
Scene incline(double slope, double friction, double duration) {
  Scene scene = contact_scene({40.0, 40.0}, 2.0);
  ToolSpec plane = make_tool_spec("plane", ToolShape::plane);
  plane.friction = friction;
  scene.tools = {plane};
  const double angle = std::atan(slope);
  scene.analysis.gravity = {gravity * std::sin(angle), 0.0, -gravity * std::cos(angle)};
  scene.analysis.duration = duration;
  scene.analysis.damping = 0.0;
  return scene;
}

double slid(const Scene& scene) {
  const Mesh mesh = build_mesh(scene, load_card(scene.fabric.material));
  return mean_displacement(mesh, run(scene).position)[0];
}

TEST(Incline, BelowTheFrictionAngleTheBlockStaysForEver) {
  const double early = slid(incline(0.28, 0.3, 0.2)), late = slid(incline(0.28, 0.3, 0.4));
  // Let fall on the plane, it settles within some bounces of 1e-3 mm. Then only rounding is left; without friction it
  // would slide 550 mm between the two times.
  EXPECT_NEAR(early, late, 1e-9);
  EXPECT_LT(late, 1e-2);
}

TEST(Incline, ThePlaneAtRestBearsTheWeightByItsComponents) {
  const Scene scene = incline(0.28, 0.3, 0.2);
  const Mesh mesh = build_mesh(scene, load_card(scene.fabric.material));
  const double mass = std::accumulate(mesh.nodes.mass.begin(), mesh.nodes.mass.end(), 0.0);
  const SolveResult result = run(scene);
  for (int c = 0; c < 3; ++c) {
    const std::string column = std::string("plane.force_") + "xyz"[c] + "_N";
    EXPECT_NEAR(at_part(result.history, column, 0.9), -mass * scene.analysis.gravity[c], 1e-3 * mass * gravity)
        << column;
  }
}

TEST(Incline, AboveTheFrictionAngleTheBlockSlidesWithTheRightAcceleration) {
  for (const double friction : {0.0, 0.1, 0.3}) {
    const double slope = 0.4, duration = 0.1, cosine = 1.0 / std::sqrt(1.0 + slope * slope);
    const double acceleration = gravity * cosine * (slope - friction);
    const double expected = 0.5 * acceleration * duration * duration;
    // The first bounces, when the weight is not yet carried, and leapfrog's half step at the start: below 1e-3 of it.
    EXPECT_NEAR(slid(incline(slope, friction, duration)), expected, 1e-3 * expected) << friction;
  }
}

TEST(Capstan, TensionGrowsByTheExponentialOfFrictionTimesAngle) {
  for (const double friction : {0.1, 0.3}) {
    const Belt belt = make_belt({}, friction);
    const History history = belt.run().history;
    // while all of it slides; the belt's inertia is 1e-3 of its tension there
    for (const double part : {0.7, 0.8, 0.9}) {
      const double ratio = at_part(history, "pulled.force_N", part) / at_part(history, "held.force_N", part);
      EXPECT_NEAR(ratio, std::exp(friction * belt.angle), 0.01 * ratio) << friction << " at " << part;
    }
  }
}

// Two plates, the upper one pushed by a force.
Scene press(double force) {
  Scene scene = contact_scene({100.0, 100.0}, 4.0);
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  upper.axis = {0.0, 0.0, -1.0};
  upper.force = force;
  lower.friction = upper.friction = 0.3;
  scene.tools = {lower, upper};
  return scene;
}

TEST(Press, ForceInIsForceOutAtEveryMoment) {
  Scene scene = press(100.0);
  scene.analysis.duration = 0.05;
  scene.analysis.step_bound = StepBound::stiffest;  // with which a tool has the blank's mass, for four times that
  const SolveResult result = run(scene);
  // the fabric between the plates has no way to take or give force but its inertia, here of 1e-5 tonne
  for (double part = 0.0; part <= 1.0; part += 0.01)
    EXPECT_NEAR(at_part(result.history, "upper.force_N", part), at_part(result.history, "lower.force_N", part), 0.5)
        << part;
  for (const double part : {0.05, 0.2, 0.5, 1.0})  // after the force has come on
    EXPECT_NEAR(at_part(result.history, "lower.force_N", part), 100.0, 0.1) << part;
  EXPECT_LT(result.statistics.contact_penetration, 0.1);
  EXPECT_LT(result.statistics.energy_error, 0.02);
}

TEST(Press, PullingTheStripOutTakesFrictionOnBothFaces) {
  Scene scene = press(100.0);
  GripSpec grip;
  grip.name = "pull";
  grip.edge = BlankEdge::right;
  grip.travel = 10.0;
  grip.free = {Component::z};
  scene.grip = {grip};
  scene.analysis.duration = 0.2;
  scene.analysis.damping = 10.0;
  const SolveResult result = run(scene);
  for (const double part : {0.5, 0.7, 0.9})  // all of it slides; what the gripped edge rests on is not friction's
    EXPECT_NEAR(at_part(result.history, "pull.force_N", part), 2.0 * 0.3 * 100.0, 0.6) << part;
  // each plate, the one at rest too, shows its friction across its axis
  for (const std::string plate : {"upper", "lower"}) {
    EXPECT_NEAR(at_part(result.history, plate + ".force_x_N", 0.7), -0.3 * 100.0, 0.3) << plate;
    EXPECT_NEAR(at_part(result.history, plate + ".force_y_N", 0.7), 0.0, 0.1) << plate;
    EXPECT_NEAR(at_part(result.history, plate + ".force_z_N", 0.7), plate == "upper" ? -100.0 : 100.0, 0.5) << plate;
  }
  EXPECT_LT(result.statistics.energy_error, 0.02);
}

}  // namespace
}  // namespace weaveform
