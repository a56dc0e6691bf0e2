// Chords against the radius of a tool. Nodes that slide over a round edge by the turn theta each lose, with both
// neighbouring chords at theta/2 to the node's tangent,
//   T2/T1 = (1 + mu tan(theta/2))/(1 - mu tan(theta/2)) ,
// against exp(mu theta) of the belt: relative to theta more by theta^2 (1 + mu^2)/12 to first order. Over the quarter
// turn of a die at mu = 0.3 that makes 5 % of the force at theta = 61 deg, chords as long as the radius.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "post/trust/chords.hpp"
#include "tests/support/ask_border.hpp"
#include "tests/support/belt.hpp"

namespace weaveform {
namespace {

using namespace test;

constexpr double friction = 0.3;
constexpr double quarter_turn = 0.5 * std::numbers::pi;

double discrete_exponent(double turn) {
  return 2.0 * std::atanh(friction * std::tan(0.5 * turn));
}

double border_of_five_percent() {
  double low = 0.1, high = 2.0;  // rad
  for (int n = 0; n < 60; ++n) {
    const double turn = 0.5 * (low + high);
    const double excess = quarter_turn * (discrete_exponent(turn) / turn - friction);
    (excess < std::log(1.05) ? low : high) = turn;
  }
  return low;
}

// A belt with chords of `ratio` radii.
Belt coarse_belt(double ratio) {
  const double interval = load_card("twintex-pw").yarn[0].interval, coarsening = 6.0;
  BeltShape shape;
  shape.coarsening = {1.0, coarsening};
  shape.width = 5.0 * interval;
  shape.radius = coarsening * interval / ratio - 0.25;
  shape.corners = 3;
  shape.pulled = 4.0;
  shape.followed = 1.5;
  return make_belt(shape, friction);
}

TEST(ToolRadius, FrictionOfAPolygonIsThatOfItsCorners) {
  for (const double ratio : {0.4, 0.8, 1.2}) {
    const Belt belt = coarse_belt(ratio);
    const History history = belt.run().history;
    const double tension = at_part(history, "pulled.force_N", 0.8) / at_part(history, "held.force_N", 0.8);
    const double expected = 3.0 * discrete_exponent(belt.turn);
    // corners have moved on by a tenth of a chord, which shares the turn out less evenly
    EXPECT_NEAR(std::log(tension), expected, 0.02 * expected) << ratio;
  }
}

TEST(ToolRadius, WarnsWhereTheForceOverADieIsFivePercentOff) {
  const double border = 2.0 * std::sin(0.5 * border_of_five_percent());
  EXPECT_NEAR(border, 1.0, 0.05);  // chords over radius; to first order 1.01
  for (const double side : {0.8, 1.25}) {
    const Belt belt = coarse_belt(side * border);
    const SolveResult result = belt.run();
    const double tension =
        at_part(result.history, "pulled.force_N", 0.8) / at_part(result.history, "held.force_N", 0.8);
    const double error = std::exp(quarter_turn * (std::log(tension) / belt.angle - friction)) - 1.0;
    EXPECT_EQ(error > 0.05, side > 1.0) << side << ": " << error;
    const Warnings said = ask(warn_of_coarse_on_tools, belt.scene, belt.card, belt.mesh, result);
    EXPECT_EQ(!said.empty(), side > 1.0) << side;
    EXPECT_TRUE(said.empty() || said.front().find("cylinder") != std::string::npos) << said.front();
  }
}

// The ratio is told from the chord alone: of any tool, whatever it is made of.
TEST(ToolRadius, AChordTellsTheRadiusThatItCuts) {
  for (const double ratio : {0.2, 0.7, 1.3, 1.9}) {
    const Belt belt = coarse_belt(ratio);
    const auto tools = place_tools(make_tools(belt.scene, belt.card.thickness),
                                   {{"time_s", "cylinder.displacement_mm"}, {{0.0, 0.0}}}, 0.0);
    const CutChord worst = worst_chord(belt.mesh, belt.mesh.nodes.position, tools);
    EXPECT_NEAR(worst.ratio(), ratio, 1e-9);
    EXPECT_NEAR(worst.radius(), *belt.scene.tools[0].radius + 0.25, 1e-6);
  }
}

// A pin between the yarns is met by no node and no yarn.
TEST(ToolRadius, APinThatPokesThroughBetweenTheYarnsIsSeen) {
  Scene scene = contact_scene({90.0, 90.0}, 6.0);
  scene.blank.phase = {0.5, 0.5};
  ToolSpec pin = make_tool_spec("pin", ToolShape::sphere);
  pin.radius = 4.0;
  pin.travel = 15.0;
  scene.tools = {pin};
  scene.analysis.duration = 0.05;
  const Card card = load_card(scene.fabric.material);
  const Mesh mesh = build_mesh(scene, card);
  const SolveResult result = run(scene);
  EXPECT_NEAR(result.history.values("pin.force_N").back(), 0.0, 1e-12);  // unnoticed by the solver
  EXPECT_EQ(ask(warn_of_coarse_on_tools, scene, card, mesh, result).size(), 1U);
}

}  // namespace
}  // namespace weaveform
