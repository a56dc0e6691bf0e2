// Plies that touch each other in one world: what does not touch keeps its bits, and what does has the same ones on any
// number of threads and across an archive.
#include "tests/support/stack_world.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "solver/contact/ply_arms.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/small_world.hpp"

namespace weaveform {
namespace {

PairLaw law_of(double friction) {
  PairLaw law;
  law.friction = friction;
  return law;
}

// A flat piece in a tension test, in the place of number `k` of a stack.
Scene stretched(double yarn_angle, double travel, int k) {
  Scene scene = test::contact_scene({80.0, 120.0}, 3.0);
  scene.blank.yarn_angle = yarn_angle;
  scene.blank.position = {0.0, 0.0, k * load_card(scene.fabric.material).thickness};
  scene.analysis.duration = 0.002;
  for (const char* edge : {"bottom", "top"}) {
    GripSpec grip;
    grip.name = edge;
    grip.edge = test::chosen(edge);
    grip.travel = grip.name == "top" ? travel : 0.0;
    scene.grip.push_back(grip);
  }
  return scene;
}

TEST(StackWorld, PliesThatLieOnEachOtherUnpressedHaveTheBitsOfTheirSingleRuns) {
  const std::vector<Scene> scenes = {stretched(45.0, 4.0, 0), stretched(0.0, 0.5, 1), stretched(30.0, 3.0, 2)};
  test::SmallWorld together(scenes, 1e-7, 1, [](int, int) { return law_of(0.0); });
  together.run(1200);
  EXPECT_EQ(together->ply_contact()->pairs()[0].force, 0.0);
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    test::SmallWorld alone({scenes[k]}, 1e-7);
    alone.run(1200);
    EXPECT_EQ(state_digest(together->ply(k)), state_digest(alone->ply(0))) << "ply " << k;
  }
}

TEST(StackWorld, PliesThatDoNotPressDoNotShortenTheStep) {
  const Scene one = stretched(45.0, 4.0, 0);
  test::SmallWorld alone({one}), stack({one, stretched(45.0, 4.0, 1)}, 1e9, 1, [](int, int) { return law_of(0.3); });
  alone->start();
  stack->start();
  EXPECT_EQ(stack->step(), alone->step());
}

// Three plies between plates, pressed and rubbed: the outer ones are held at one side, the middle one is pulled.
std::vector<Scene> rubbed(ContactThickness thickness = ContactThickness::card) {
  Scene scene = test::contact_scene({90.0, 60.0}, 2.0);
  scene.model.contact_thickness = thickness;
  const double t = load_card(scene.fabric.material).thickness;
  ToolSpec lower = test::make_tool_spec("lower", ToolShape::plane),
           upper = test::make_tool_spec("upper", ToolShape::plane);
  lower.position = {0.0, 0.0, -0.5 * t};
  upper.position = {0.0, 0.0, 2.5 * t};
  upper.axis = {0.0, 0.0, -1.0};
  upper.travel = 0.1;
  lower.friction = upper.friction = 0.2;
  scene.tools = {lower, upper};
  scene.analysis.duration = 0.004;
  std::vector<Scene> scenes(3, scene);
  for (int k = 0; k < 3; ++k) {
    scenes[k].blank.position = {0.0, 0.0, k * t};
    scenes[k].blank.yarn_angle = 30.0 * k;
    GripSpec grip;
    grip.name = "grip";
    grip.edge = k == 1 ? BlankEdge::right : BlankEdge::left;
    grip.travel = k == 1 ? 2.0 : 0.0;
    grip.free = {Component::z};
    scenes[k].grip = {grip};
  }
  return scenes;
}

TEST(StackWorld, HasTheSameBitsOnAnyNumberOfThreads) {
  for (const ContactThickness thickness : {ContactThickness::card, ContactThickness::sheared}) {
    std::vector<std::uint64_t> digests;
    for (const int threads : {1, 2, 4}) {
      test::SmallWorld world(rubbed(thickness), 1e9, threads, [](int, int) { return law_of(0.3); });
      world.run(800);
      EXPECT_GT(world->ply_contact()->pairs()[0].force, 1.0);
      EXPECT_GT(world->ply_contact()->friction_work(), 0.0);
      digests.push_back(state_digest(*world));
    }
    EXPECT_EQ(digests[0], digests[1]);
    EXPECT_EQ(digests[0], digests[2]);
  }
}

TEST(StackWorld, GoesOnWithTheSameBitsAfterItsArchiveWasRead) {
  const auto law = [](int, int) {
    PairLaw both = law_of(0.3);
    both.shear_law = {{0.0, 0.001}, {1.0, 0.01}};
    return both;
  };
  const auto scenes = rubbed(ContactThickness::sheared);
  test::SmallWorld run(scenes, 1e9, 1, law), resumed(scenes, 1e9, 1, law);
  run.run(700);
  const std::string kept = state_bytes(*run);
  StateReader reader(kept);
  resumed->archive(reader);
  EXPECT_EQ(reader.left(), 0U);
  EXPECT_EQ(state_digest(*resumed), state_digest(*run));
  run.run(700);
  resumed.run(700);
  EXPECT_EQ(state_digest(*resumed), state_digest(*run));
  EXPECT_EQ(resumed->ply_contact()->pairs()[0].friction_work, run->ply_contact()->pairs()[0].friction_work);
  EXPECT_EQ(resumed->ply_contact()->state_of(1).slip_path, run->ply_contact()->state_of(1).slip_path);
}

// A node whose yarns have come to lie along each other turns its normal by ever so little a force: its friction would set
// a step that no run ends with.
TEST(StackWorld, AStepThatComesToNothingIsSaidInWords) {
  test::SmallWorld world(rubbed(), 1e9, 1, [](int, int) { return law_of(0.3); });
  world.run(400);
  ASSERT_GT(world->ply_contact()->pairs()[0].force, 0.0);
  EXPECT_EQ(world->endless_run(), "");
  Ply& middle = world->ply(1);
  const auto arms = node_arms(middle.mesh(), middle.packed());
  for (int n = 0; n < middle.mesh().node_count(); ++n) {
    const auto& at = middle.mesh().nodes.position[n];
    const auto& arm = arms[middle.packed().packed_of_mesh[n]].arm;
    if (std::hypot(at[0], at[1]) > 8.0 || middle.mesh().nodes.crossing[n][0] < 0) continue;
    for (auto& x : middle.state().position) x[arm[1]] = x[arm[0]] + 1.00001 * (x[arm[3]] - x[arm[2]]);
    middle.state().position[0][arm[1]] += 1e-6;
    break;
  }
  world->renew_step();
  const std::string said = world->endless_run();
  EXPECT_NE(said.find("the stable step has come down to"), std::string::npos) << said << world->stable_step().step;
  EXPECT_NE(said.find("set by the bending and contact at node"), std::string::npos) << said;
}

TEST(StackWorld, PressForceInIsPressForceOutAndTheBalanceCloses) {
  auto scenes = rubbed();
  for (auto& scene : scenes) scene.analysis.duration = 0.05;
  test::StackWorld world(scenes, law_of(0.3));
  world.run_to(1.0);
  const auto& readings = world->tools()->readings();
  EXPECT_NEAR(readings[0].force, readings[1].force, 0.001 * std::abs(readings[1].force));
  world->look_at_stored_energy();
  EXPECT_LT(world->balance().error(), 0.002);
  EXPECT_GT(world->ply_contact()->friction_work(), 0.1 * world->balance().external);
}

}  // namespace
}  // namespace weaveform
