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
// times the angle, and its edge stays behind by that when it slides freely. (Bonded ones: below, in bending.)
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
  scene.model.cell = CellElement::rotation_free;  // limp, but for folds of a cell's length
  scene.model.cell_bending = {0.1, 0.1, 0.01};
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

TEST(Stack, BentThroughAnAngleNeighbouringEdgesMoveByThicknessTimesAngle) {
  const double radius = 50.0, t = load_card("twintex-pw").thickness, expected = 0.5 * std::numbers::pi * t;
  StackWorld free(draped_stack(radius, 2, 1.0), coulomb(0.0));
  free.run_to(1.0);
  EXPECT_NEAR(lowest_edge(free, 1) - lowest_edge(free, 0), expected, 0.02 * expected);
  // and that is what the contact says at the free edge
  double greatest = 0.0;
  for (const auto& slip : free->ply_contact()->state_of(1).slip) greatest = std::max(greatest, length(slip));
  EXPECT_NEAR(greatest, expected, 0.05 * expected);
  EXPECT_LT(free.energy_error(), 0.01);
}

// Two cantilevers on each other, the upper one heavy, both as stiff in bending as `rigidity`.
std::vector<Scene> cantilevers(double rigidity, double acceleration) {
  Scene scene = contact_scene({98.4, 14.76}, 1.0);
  scene.grip = {grip("held", BlankEdge::left, 0.0, {})};
  scene.model.cell = CellElement::rotation_free;
  scene.model.cell_bending = {rigidity, rigidity, 0.1 * rigidity};
  scene.model.yarn_law = YarnLaw::linear;
  scene.model.section = Section::constant;
  scene.model.compression_modulus = 19800.0;
  scene.analysis.duration = 0.1;
  scene.analysis.damping = 150.0;
  std::vector<Scene> scenes(2, scene);
  scenes[1].blank.position = {0.0, 0.0, load_card(scene.fabric.material).thickness};
  scenes[1].analysis.gravity = {0.0, 0.0, -acceleration};
  return scenes;
}

// At the free end.
struct Tip {
  double sag = 0.0, slip = 0.0;  // mm; slip of the upper ply over the lower one
};
Tip tip_of(StackWorld& world) {
  double far = -1e9, sag = 0.0, slip = 0.0;
  int count = 0;
  for (const auto& at : world.mesh(1).nodes.position) far = std::max(far, at[0]);
  const auto now = world->ply(1).positions();
  const auto state = world->ply_contact()->state_of(1);
  for (int n = 0; n < world.mesh(1).node_count(); ++n) {
    const auto& at = world.mesh(1).nodes.position[n];
    if (at[0] < far - 1e-6) continue;
    sag += at[2] - now[n][2];
    slip += length(state.slip[n]);
    ++count;
  }
  return {sag / count, slip / count};
}

// Tip of two layers at distance d, each with B = D/2 in bending and EA in tension per width, on an elastic bond of
// stiffness kappa (Newmark, Siess & Viest 1951): curvature c = (M - N d)/D, N'' - lambda^2 N = -kappa d M/D,
// lambda^2 = kappa (d^2/D + 2/EA), N' = 0 at the root and N = 0 at the tip, M = q (L - x)^2/2.
double bonded_sag(double q, double length, double d, double bending, double tension, double bond) {
  const double lambda = std::sqrt(bond * (d * d / bending + 2.0 / tension)),
               alpha = bond * d / (bending * lambda * lambda);
  const double c = alpha * q * length / lambda;
  const double a = -(alpha * q / (lambda * lambda) + c * std::sinh(lambda * length)) / std::cosh(lambda * length);
  double sag = 0.0;
  const int intervals = 20000;
  for (int n = 0; n < intervals; ++n) {
    const double x = length * (n + 0.5) / intervals, moment = 0.5 * q * (length - x) * (length - x);
    const double force =
        alpha * (moment + q / (lambda * lambda)) + a * std::cosh(lambda * x) + c * std::sinh(lambda * x);
    sag += (moment - force * d) / bending * (length - x) * length / intervals;
  }
  return sag;
}

TEST(Stack, BendsAsItsPliesTogetherWhenFreeAndByTheParallelAxesWhenBonded) {
  const double rigidity = 50.0, acceleration = 6000.0;
  const Card card = load_card("twintex-pw");
  StackWorld free(cantilevers(rigidity, acceleration), coulomb(0.0));
  free.run_to(1.0);
  const double length = 98.4, density = free->ply(1).mass() / (length * 14.76), q = density * acceleration;
  const double alone = q * std::pow(length, 4) / (8.0 * 2.0 * rigidity);
  const Tip apart = tip_of(free);
  EXPECT_NEAR(apart.sag, alone, 0.02 * alone);
  // the tip turns by q L^3/(6 D), and its faces slip by that times the thickness
  EXPECT_NEAR(apart.slip, card.thickness * q * std::pow(length, 3) / (12.0 * rigidity), 0.03 * apart.slip);

  StackWorld bonded(cantilevers(rigidity, acceleration), coulomb(1e5));
  bonded.run_to(1.0);
  const double frequency = contact_frequency({}, bonded->ply(0).fabric_step());
  const TouchingPly ply = {
      .thickness = card.thickness, .density = density, .spacing = 4.92, .node_mass = density * 4.92 * 4.92};
  const PairTables none;
  const double bond = spring_stiffness(ply, ply, frequency) * pass_law({}, none, ply, ply, true, frequency).tangential;
  const double tension = 19800.0 * 1.25 / 4.92;
  const double expected = bonded_sag(q, length, card.thickness, 2.0 * rigidity, tension, bond);
  const Tip together = tip_of(bonded);
  ASSERT_LT(expected, 0.3 * alone);
  EXPECT_NEAR(together.sag, expected, 0.05 * expected);
  EXPECT_LT(std::abs(together.slip), 0.1 * apart.slip);
}

// The inner ply lies still on a cylinder, the outer one is drawn over it. Both are polygons of the same cells: as the
// outer one slides by a cell, the ratio goes to and fro about its mean, by 10 %, so that the mean is one over the way of a
// whole cell. It begins once tension has built up, after 4 mm of slip; it is the same
// within 0.2 % for starts that differ by 1e-7 of the duration. Of the 2 %, inertia has 0.6: 1.823, 1.829, 1.832 at 0.12,
// 0.24, 0.36 s.
TEST(Stack, CapstanOfTwoPlies) {
  const double friction = 0.3, settled = 4.0;
  Belt inner = make_belt({}, 0.0), outer = make_belt({.pulled = 18.0, .followed = 13.5}, 0.0);
  for (auto& held : inner.scene.grip) held.travel = 0.0;
  for (auto* belt : {&inner, &outer}) belt->scene.analysis.duration = 0.12;
  StackWorld world({inner.scene, outer.scene}, coulomb(friction), 1, [&](std::size_t k, Mesh& mesh) {
    mesh.nodes.flat_position = mesh.nodes.position;  // it starts draped: chords meet no better
    lay_over(mesh, 50.0 + (0.5 + static_cast<double>(k)) * inner.card.thickness, inner.angle);
  });
  const double cell = inner.mesh.spacing[0];
  double sum = 0.0, way = 0.0, before = settled;
  int seen = 0;
  world.run_to(0.97, [&] {
    if (++seen % 20 != 0 || way >= cell) return;
    const double now = world->ply_contact()->pairs()[0].greatest_slip;
    if (now <= before) return;
    const auto& force = world->ply(1).holds().whole_forces();
    sum += (now - before) * std::log(force[1] / force[0]);
    way += now - before;
    before = now;
  });
  ASSERT_GE(way, cell) << "it should slide by a cell";
  const double ratio = std::exp(sum / way);
  EXPECT_NEAR(ratio, std::exp(friction * inner.angle), 0.02 * ratio);
}

// A finer patch between two whole plies, drawn by a hemisphere: the outer two come to touch around it.
TEST(Stack, PatchThatEndsInsideThePartIsDrawnWithIt) {
  Scene scene = drawing();
  const double t = load_card(scene.fabric.material).thickness;
  scene.tools[0].position = {0.0, 0.0, 2.5 * t};
  scene.tools[1].position = {0.0, 0.0, -0.5 * t};
  scene.tools[2].position = {0.0, 0.0, 2.5 * t + *scene.tools[2].radius};
  scene.tools[0].damping = 2e4;  // the binder does not fall on the stack through the patch's thickness
  std::vector<Scene> scenes(3, scene);
  for (int k = 0; k < 3; ++k) scenes[k].blank.position = {0.0, 0.0, k * t};
  scenes[1].blank.size = {40.0, 30.0};
  scenes[1].blank.coarsening = {1.3, 1.3};
  scenes[1].blank.yarn_angle = 30.0;
  StackWorld world(scenes, coulomb(0.2));
  world.run_to(1.0);
  const auto& readings = world->tools()->readings();  // binder, die, punch
  EXPECT_NEAR(readings[1].force, readings[0].force + readings[2].force, 0.01 * readings[1].force);
  EXPECT_NEAR(readings[0].force, 50.0, 1.0);
  const auto pairs = world->ply_contact()->pairs();
  for (const auto& pair : pairs) EXPECT_GT(pair.force, 0.0) << pair.lower << " and " << pair.upper;
  EXPECT_LT(world->ply_contact()->greatest_depth(), 0.25 * t);
  EXPECT_LT(world.energy_error(), 0.01);
}

}  // namespace
}  // namespace weaveform
