// Stacks of plies against known answers: pulled out of each other, bent, drawn over a cylinder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "solver/contact/contact.hpp"
#include "solver/contact/ply_law.hpp"
#include "tests/support/belt.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/stack_world.hpp"

namespace weaveform {
namespace {

using namespace test;

PairLaw coulomb(double friction) {
  PairLaw law;
  law.friction = friction;
  return law;
}

GripSpec grip(const std::string& name, BlankEdge edge, double travel, std::vector<Component> free) {
  GripSpec made;
  made.name = name;
  made.edge = edge;
  made.travel = travel;
  made.free = std::move(free);
  return made;
}

// Three plies between two plates without friction, the outer ones held at one end, the middle one pulled at the other.
std::vector<Scene> pulled_stack(double press, double travel) {
  Scene scene = contact_scene({120.0, 60.0}, 2.0);
  const double t = load_card(scene.fabric.material).thickness;
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  lower.position = {0.0, 0.0, -0.5 * t};
  upper.position = {0.0, 0.0, 2.5 * t};
  upper.axis = {0.0, 0.0, -1.0};
  upper.force = press;
  scene.tools = {lower, upper};
  scene.analysis.duration = 0.2;
  scene.analysis.damping = 10.0;
  std::vector<Scene> scenes(3, scene);
  for (std::size_t k = 0; k < 3; ++k) {
    scenes[k].blank.position = {0.0, 0.0, static_cast<double>(k) * t};
    scenes[k].grip = {k == 1 ? grip("pull", BlankEdge::right, travel, {Component::z})
                             : grip("held", BlankEdge::left, 0.0, {Component::z})};
  }
  return scenes;
}

TEST(Stack, MiddlePlyPulledOutTakesFrictionOnBothFaces) {
  const double press = 100.0, friction = 0.3;
  StackWorld world(pulled_stack(press, 10.0), coulomb(friction));
  world.run_to(0.4);
  for (const double part : {0.55, 0.7, 0.85})
    EXPECT_NEAR(world.mean_force(1, 0, part), 2.0 * friction * press, 0.01 * 2.0 * friction * press) << part;
  const auto pairs = world->ply_contact()->pairs();
  for (const auto& pair : pairs) {
    if (pair.upper != pair.lower + 1) continue;
    EXPECT_NEAR(pair.force, press, 0.03 * press);
    EXPECT_NEAR(pair.friction_force, friction * press, 0.04 * friction * press);
    EXPECT_GT(pair.greatest_slip, 5.0);
  }
  EXPECT_EQ(pairs[1].force, 0.0) << "the outer two have a ply between them";
  // what the pull did is what friction took, but for what stretches the yarns
  EXPECT_LT(world.energy_error(), 0.01);
  EXPECT_GT(world->ply_contact()->friction_work(), 0.8 * world->ply(1).holds().work());
}

// Hanging over a quarter of a cylinder by their own weight, held on top: the outer ply's way is longer by its thickness
// times the angle, and its edge stays behind by that when it slides freely, not when it is bonded.
std::vector<Scene> draped_stack(double radius, int plies, double coarsening) {
  Scene scene = contact_scene({140.0, 3.1 * 4.92 * coarsening}, coarsening);
  const double t = load_card(scene.fabric.material).thickness;
  ToolSpec cylinder = make_tool_spec("cylinder", ToolShape::cylinder);
  cylinder.radius = radius;
  cylinder.axis = {0.0, 1.0, 0.0};
  cylinder.position = {{-60.0, 0.0, -radius - 0.5 * t}};
  scene.tools = {cylinder};
  scene.grip = {grip("held", BlankEdge::left, 0.0, {})};
  scene.model.yarn_law = YarnLaw::linear;
  scene.analysis.gravity = {0.0, 0.0, -10.0 * gravity};
  scene.analysis.duration = 0.15;
  scene.analysis.damping = 100.0;
  std::vector<Scene> scenes(plies, scene);
  for (int k = 0; k < plies; ++k) scenes[k].blank.position = {0.0, 0.0, k * t};
  return scenes;
}

double lowest_edge(StackWorld& world, std::size_t k) {
  double lowest = 1e9;
  for (const auto& x : world->ply(k).positions()) lowest = std::min(lowest, x[2]);
  return lowest;
}

TEST(Stack, BentThroughAnAngleNeighbouringEdgesMoveByThicknessTimesAngleUnlessBonded) {
  const double radius = 50.0, t = load_card("twintex-pw").thickness, expected = 0.5 * std::numbers::pi * t;
  StackWorld free(draped_stack(radius, 3, 1.0), coulomb(0.0));
  free.run_to(1.0);
  for (const std::size_t k : {1U, 2U}) {
    EXPECT_NEAR(lowest_edge(free, k) - lowest_edge(free, k - 1), expected, 0.02 * expected) << k;
    // and that is what the contact says at the free edge; the path has been longer, to and fro
    double greatest = 0.0;
    for (const auto& slip : free->ply_contact()->state_of(static_cast<int>(k)).slip)
      greatest = std::max(greatest, length(slip));
    EXPECT_NEAR(greatest, expected, 0.05 * expected) << k;
    EXPECT_GE(free->ply_contact()->pairs()[k == 1 ? 0 : 2].greatest_slip, 0.95 * expected);
  }
  EXPECT_LT(free.energy_error(), 0.01);
  // a bond by friction needs pressure everywhere: the upper ply is blown at from outside
  auto scenes = draped_stack(radius, 2, 1.0);
  scenes[1].analysis.gravity[0] = scenes[1].analysis.gravity[2];
  StackWorld bonded(scenes, coulomb(50.0));
  bonded.run_to(1.0);
  double slipped = 0.0;
  for (const auto& slip : bonded->ply_contact()->state_of(1).slip) slipped = std::max(slipped, length(slip));
  EXPECT_LT(slipped, 0.1 * expected);
  EXPECT_LT(bonded.energy_error(), 0.01);
}

}  // namespace
}  // namespace weaveform
