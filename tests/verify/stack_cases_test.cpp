// Stacks as they come: patches on top, holes, plies bonded to each other. Force in is force out, nothing goes through, the
// balance closes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/contact_scene.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/stack_world.hpp"

namespace weaveform {
namespace {

using namespace test;

PairLaw rubs(double friction) {
  PairLaw law;
  law.friction = friction;
  return law;
}

double ply_thickness() {
  static const double t = load_card("twintex-pw").thickness;
  return t;
}

// The small deep drawing of contact_scene.hpp, of so many plies on each other.
std::vector<Scene> drawn_stack(std::size_t plies, double travel) {
  Scene scene = drawing();
  const double t = ply_thickness(), top = (static_cast<double>(plies) - 0.5) * t;
  scene.tools[0].position = {0.0, 0.0, top};
  scene.tools[1].position = {0.0, 0.0, -0.5 * t};
  scene.tools[2].position = {0.0, 0.0, top + *scene.tools[2].radius};
  scene.tools[2].travel = travel;
  scene.tools[0].damping = 2e4;  // the binder follows the stack without falling on it
  std::vector<Scene> scenes(plies, scene);
  for (std::size_t k = 0; k < plies; ++k) scenes[k].blank.position = {0.0, 0.0, static_cast<double>(k) * t};
  return scenes;
}

// What every drawn stack must show: binder and punch in is die out, and no ply goes deep into another.
void expect_sound(StackWorld& world, double deepest) {
  const auto& readings = world->tools()->readings();  // binder, die, punch
  EXPECT_NEAR(readings[0].force, 50.0, 1.0);
  EXPECT_NEAR(readings[1].force, readings[0].force + readings[2].force, 0.01 * readings[1].force);
  for (const auto& pair : world->ply_contact()->pairs())
    EXPECT_LT(pair.greatest_depth, deepest * ply_thickness()) << pair.lower << " and " << pair.upper;
  EXPECT_LT(world.energy_error(), 0.01);
}

TEST(StackCases, APatchOnTopIsPressedInByThePunch) {
  auto scenes = drawn_stack(2, 15.0);
  scenes[0].tools[0].position = {0.0, 0.0, 0.5 * ply_thickness()};  // the binder holds the whole ply alone
  scenes[1].blank.size = {36.0, 36.0};
  scenes[1].blank.coarsening = {1.5, 1.5};
  scenes[1].blank.yarn_angle = 45.0;
  StackWorld world(scenes, rubs(0.2));
  world.run_to(1.0);
  expect_sound(world, 0.25);
  const auto pair = world->ply_contact()->pairs()[0];
  const double punch = world->tools()->readings()[2].force;
  EXPECT_GT(pair.force, 0.3 * punch) << "the punch presses through the patch";
}

// A ply with a hole between two whole ones: they meet through it, and nowhere else.
TEST(StackCases, PliesMeetThroughAHoleOfThePlyBetweenThem) {
  const TemporaryFolder folder;
  std::string outline = "x_mm,y_mm\n-60,-60\n60,-60\n60,60\n-60,60\n-60,-60\n\n";
  const double radius = 24.0;
  for (int n = 0; n <= 24; ++n)
    outline += std::to_string(radius * std::cos(n * std::numbers::pi / 12.0)) + "," +
               std::to_string(radius * std::sin(n * std::numbers::pi / 12.0)) + "\n";
  write_text(outline, folder.path() / "hole.csv");
  auto scenes = drawn_stack(3, 15.0);
  scenes[1].blank.shape = BlankShape::file;
  scenes[1].blank.outline = (folder.path() / "hole.csv").string();
  for (auto& scene : scenes) {
    scene.blank.coarsening = {2.0, 2.0};
    scene.analysis.loading_speed = 600.0;
  }
  StackWorld world(scenes, rubs(0.2));
  ASSERT_LT(world.mesh(1).cells.size(), 0.95 * world.mesh(0).cells.size()) << "it has a hole";
  world.run_to(1.0);
  expect_sound(world, 0.3);
  EXPECT_GT(world->ply_contact()->pairs()[1].force, 1.0);
  int through = 0;
  for (const int outer : {0, 2}) {
    const auto state = world->ply_contact()->state_of(outer);
    for (int n = 0; n < world.mesh(outer).node_count(); ++n) {
      const auto& x = world.mesh(outer).nodes.position[n];
      if (state.other[n] != 2 - outer) continue;
      ++through;
      EXPECT_LT(std::hypot(x[0], x[1]), radius + 10.0) << "the ply between them lies there";
    }
  }
  EXPECT_GT(through, 1);
}

// Mean place of a ply's nodes that are nearest to x when it is flat.
Vec3 mean_at(StackWorld& world, std::size_t k, double x) {
  const auto now = world->ply(k).positions();
  double nearest = 1e9;
  for (const auto& at : world.mesh(k).nodes.position) nearest = std::min(nearest, std::abs(at[0] - x));
  Vec3 sum = {0.0, 0.0, 0.0};
  int count = 0;
  for (int n = 0; n < world.mesh(k).node_count(); ++n) {
    if (std::abs(world.mesh(k).nodes.position[n][0] - x) > nearest + 1e-6) continue;
    sum = plus(sum, now[n]);
    ++count;
  }
  return scaled(sum, 1.0 / count);
}

// Two plies that hang over a quarter of a cylinder by their weight, held on top. Free, the upper one's edge stays behind by
// t times the angle; bonded (friction and a binder that never give way), it does not.
TEST(StackCases, BondedPliesBentOverACylinderKeepTheirEdgesTogether) {
  Scene scene = contact_scene({140.0, 3.1 * 4.92}, 1.0);
  const double t = ply_thickness(), radius = 50.0;
  ToolSpec cylinder = make_tool_spec("cylinder", ToolShape::cylinder);
  cylinder.radius = radius;
  cylinder.axis = {0.0, 1.0, 0.0};
  cylinder.position = {{-60.0, 0.0, -radius - 0.5 * t}};
  scene.tools = {cylinder};
  GripSpec held;
  held.name = "held";
  held.edge = BlankEdge::left;
  scene.grip = {held};
  scene.model.yarn_law = YarnLaw::linear;
  scene.model.cell = CellElement::rotation_free;
  scene.model.cell_bending = {0.1, 0.1, 0.01};
  scene.analysis.gravity = {0.0, 0.0, -10.0 * gravity};
  scene.analysis.duration = 0.15;
  scene.analysis.damping = 100.0;
  std::vector<Scene> scenes(2, scene);
  scenes[1].blank.position = {0.0, 0.0, t};
  PairLaw bond = rubs(1e4);
  bond.shear_law = {{0.0, 5.0}};  // MPa; where nothing presses, too
  StackWorld world(scenes, bond);
  world.run_to(1.0);
  // how far the upper edge is behind the lower one along the strip's end
  const Vec3 lower = mean_at(world, 0, 70.0), upper = mean_at(world, 1, 70.0);
  const Vec3 along = unit(minus(lower, mean_at(world, 0, 60.0)));
  ASSERT_LT(along[2], -0.9) << "bent through nearly a right angle";
  const double free = std::acos(-along[2]) < 0.5 ? (0.5 * std::numbers::pi - std::acos(-along[2])) * t : 0.0;
  EXPECT_NEAR(dot(minus(upper, lower), along), 0.0, 0.05 * free);
  double slipped = 0.0;
  for (const auto& slip : world->ply_contact()->state_of(1).slip) slipped = std::max(slipped, length(slip));
  EXPECT_LT(slipped, 0.1 * free);
}

}  // namespace
}  // namespace weaveform
