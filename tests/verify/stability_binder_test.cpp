// A tool pushed by a force stands on the springs of contact, N(x) = A x^2 while nodes sink in by less than the depth
// over which the normal force sets in (contact_kernel.hpp), and moves by m x" = F(t) - N(x) - c m x'. That oscillator,
// with A from a run at rest, tells where the force that the fabric feels is off by 1 %.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "solver/constraint/grips.hpp"
#include "solver/contact/contact.hpp"
#include "solver/contact/tool_motion.hpp"
#include "tests/support/ask_border.hpp"
#include "tests/support/contact_scene.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double force = 20.0, duration = 0.1;  // N, s
constexpr double greatest_error = 0.01;

// A strip pressed between plates and pulled out slowly.
Scene pressed(double mass, double damping) {
  Scene scene = contact_scene({60.0, 60.0}, 3.0);
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  upper.axis = {0.0, 0.0, -1.0};
  upper.force = force;
  upper.mass = mass;
  upper.damping = damping;
  scene.tools = {lower, upper};
  GripSpec grip;
  grip.name = "pull";
  grip.edge = BlankEdge::right;
  grip.travel = 1.0;
  grip.free = {Component::z};
  scene.grip = {grip};
  scene.analysis.duration = duration;
  return scene;
}

// N/mm^2; A.
double contact_law() {
  const History history = run(pressed(1e-4, 1000.0)).history;
  const double x = history.values("upper.displacement_mm").back();
  EXPECT_LT(0.5 * x, contact_softening * 0.5);  // half on either face, of 0.5 mm: where the law is a square
  return history.values("upper.force_N").back() / (x * x);
}

// 1; greatest |N - F|/F of the oscillator, N a mean over each row of the history, from twice the onset on.
double predicted(double law, double mass, double damping) {
  constexpr int rows = 100, steps = 2000;  // of a row, which reaches from half a row before its time to half after
  const double dt = duration / rows / steps;
  double x = 0.0, v = 0.0, worst = 0.0, sum = 0.0;
  for (int n = 0; n < (rows - 1) * steps; ++n) {
    const double felt = x > 0.0 ? law * x * x : 0.0;
    v += dt * (force * smooth_step(n * dt / (force_rise * duration)) - felt - damping * mass * v) / mass;
    x += dt * v;
    sum += felt / steps;
    if ((n + steps / 2) % steps != 0) continue;
    const int row = n / steps;
    if (row >= 2.0 * force_rise * rows) worst = std::max(worst, std::abs(sum - force) / force);
    sum = 0.0;
  }
  return worst;
}

struct Seen {
  double off = 0.0;
  bool warned = false;
};

Seen seen(double mass, double damping) {
  const Scene scene = pressed(mass, damping);
  const Card card = load_card(scene.fabric.material);
  const SolveResult result = run(scene);
  Seen seen;
  for (double part = 2.0 * force_rise; part < 1.0; part += 0.01)
    seen.off = std::max(seen.off, std::abs(at_part(result.history, "upper.force_N", part) - force) / force);
  seen.warned = !ask(warn_of_unsteady_tools, scene, card, build_mesh(scene, card), result).empty();
  return seen;
}

// Where the prediction crosses 1 % between a value that holds and one that fails.
template <class Predict>
double bisect(Predict predict, double holds, double fails) {
  for (int n = 0; n < 12; ++n) {
    const double middle = std::sqrt(holds * fails);
    (predict(middle) < greatest_error ? holds : fails) = middle;
  }
  return holds;
}

TEST(BinderDamping, TooMuchLagsBehindTheForce) {
  const double law = contact_law(), mass = 1e-4;
  const double greatest = bisect([&](double c) { return predicted(law, mass, c); }, 1e4, 1e9);
  const Seen below = seen(mass, greatest / 1.2), above = seen(mass, greatest * 1.2);
  EXPECT_LT(below.off, greatest_error) << greatest;
  EXPECT_FALSE(below.warned);
  EXPECT_GT(above.off, greatest_error) << greatest;
  EXPECT_TRUE(above.warned);
}

TEST(BinderDamping, TooLittleLetsAHeavyBinderSwing) {
  // tangent K = 2 A x of the spring under the force; the force comes on within 8/omega, soon enough to set it swinging
  const double law = contact_law(), tangent = 2.0 * std::sqrt(law * force);
  const double frequency = 8.0 / (force_rise * duration), mass = tangent / (frequency * frequency);
  const double least = bisect([&](double c) { return predicted(law, mass, c); }, frequency, 1.0);
  const Seen above = seen(mass, least * 1.5), below = seen(mass, least / 1.5);
  EXPECT_LT(above.off, greatest_error) << least;
  EXPECT_FALSE(above.warned);
  EXPECT_GT(below.off, greatest_error) << least;
  EXPECT_TRUE(below.warned);
}

// The contact springs bear k (t - d/2) per node before a node is in the tool by the thickness t.
TEST(BinderForce, MoreThanTheSpringsBearStops) {
  const double law = contact_law(), thickness = 0.5, softening = contact_softening * thickness;
  const double stiffness = 8.0 * softening * law;  // N/mm; of all nodes on one face: N = k p^2/2d, p = x/2
  const double greatest = stiffness * (thickness - 0.5 * softening);
  Scene scene = pressed(1e-4, 1e4);
  scene.grip[0].travel = 0.0;
  scene.tools[1].force = 0.85 * greatest;
  EXPECT_NO_THROW((void)run(scene));
  scene.tools[1].force = 1.15 * greatest;
  EXPECT_THROW((void)run(scene), PhysicsError);
}

}  // namespace
}  // namespace weaveform
