// Several plies in one world.
#include "solver/analysis/world.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/chosen.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/small_world.hpp"

namespace weaveform {
namespace {

constexpr double duration = 0.002;  // s

Scene pulled(const std::string& material, double yarn_angle, double travel) {
  Scene scene = test::contact_scene({80.0, 120.0}, 4.0);
  scene.fabric.material = material;
  scene.blank.yarn_angle = yarn_angle;
  scene.analysis.duration = duration;
  for (const char* edge : {"bottom", "top"}) {
    GripSpec grip;
    grip.name = edge;
    grip.edge = test::chosen(edge);
    grip.travel = grip.name == "top" ? travel : 0.0;
    scene.grip.push_back(grip);
  }
  return scene;
}

// Steps that every one of the plies may take.
constexpr double shared_step = 1e-7;  // s

TEST(World, GivesPliesThatDoNotTouchTheBitsOfTheirSingleRuns) {
  Scene beams = pulled("twintex-tw", 45.0, 4.0), shells = pulled("twintex-pw", 0.0, 1.0),
        incremental = pulled("twintex-pw", 30.0, 3.0);
  beams.model.yarn = YarnElement::beam;
  beams.model.formulation = Formulation::contravariant;
  shells.model.cell = CellElement::shell;
  incremental.model.formulation = Formulation::incremental;
  const std::vector<Scene> scenes = {beams, shells, incremental};
  test::SmallWorld together(scenes, shared_step);
  together.run(1200);
  EXPECT_EQ(together->step_set_by(), "longest step asked for");
  double moved = 0.0;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    test::SmallWorld alone({scenes[k]}, shared_step);
    alone.run(1200);
    EXPECT_EQ(state_digest(together->ply(k)), state_digest(alone->ply(0))) << "ply " << k;
    moved = std::max(moved, std::abs(alone->ply(0).holds().displacement().back()));
  }
  EXPECT_GT(moved, 0.001) << "nothing happened";
}

// Forces and motion of the free nodes in one pass, the outer bands of each thread and the waiting nodes after it.
TEST(World, OnePassGivesTheBitsOfForcesAndThenMotion) {
  for (const double yarn_angle : {0.0, 20.0, 45.0})
    for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
      Scene scene = pulled("twintex-pw", yarn_angle, 4.0);
      scene.blank.size = {160.0, 240.0};
      scene.blank.coarsening = {1.0, 1.0};
      scene.analysis.precision = precision;
      scene.analysis.step_bound = StepBound::stiffest;
      scene.analysis.damping = 5.0;
      test::SmallWorld in_turn({scene});
      in_turn.run(60);
      for (const int threads : {1, 2, 3}) {
        test::SmallWorld at_once({scene}, std::numeric_limits<double>::infinity(), threads);
        at_once->start();
        ASSERT_TRUE(at_once->moves_in_one_pass());
        at_once->advance(false);
        for (int n = 1; n < 60; ++n) {
          at_once->compute_forces_and_advance();
          EXPECT_FALSE(at_once->passes_reach());
        }
        at_once->compute_forces();
        EXPECT_FALSE(at_once->passes_reach());
        EXPECT_EQ(state_digest(*at_once), state_digest(*in_turn)) << yarn_angle << " deg, " << threads << " threads";
      }
    }
}

// Without z the same sums in the same order: what z would add is zero.
TEST(World, AFlatPlyMovesInItsPlaneWithTheBitsOfOneInSpace) {
  for (const std::string card : {"twintex-pw", "twintex-tw"})
    for (const double yarn_angle : {0.0, 20.0, 45.0}) {
      Scene scene = pulled(card, yarn_angle, 4.0);
      scene.blank.size = {160.0, 240.0};
      test::SmallWorld in_space({scene});
      in_space->ply(0).leave_plane();
      in_space.run(300);
      EXPECT_FALSE(in_space->ply(0).is_flat());
      for (const int threads : {1, 2}) {
        test::SmallWorld flat({scene}, std::numeric_limits<double>::infinity(), threads);
        flat.run(300);
        EXPECT_TRUE(flat->ply(0).is_flat());
        EXPECT_EQ(state_digest(*flat), state_digest(*in_space)) << card << ", " << yarn_angle << " deg";
      }
    }
}

TEST(World, WhatMayLeaveThePlaneIsSolvedInSpace) {
  const auto is_flat = [](const Scene& scene) {
    test::SmallWorld world({scene});
    world->start();
    return world->ply(0).is_flat();
  };
  const Scene flat = pulled("twintex-pw", 30.0, 4.0);
  EXPECT_TRUE(is_flat(flat));
  Scene weight = flat, beams = flat, lifted = flat, pulled_up = flat, single = flat, contravariant = flat;
  weight.analysis.gravity = {0.0, 0.0, -9810.0};
  beams.model.yarn = YarnElement::beam;
  lifted.blank.position[2] = 1.0;
  pulled_up.grip.back().direction = Vec3{0.0, 1.0, 1e-3};
  single.analysis.precision = Precision::single_precision;  // has no loops of its own for the plane
  contravariant.model.formulation = Formulation::contravariant;
  for (const Scene& scene : {weight, beams, lifted, pulled_up, single, contravariant, test::drawing()})
    EXPECT_FALSE(is_flat(scene));
}

TEST(World, WithAnActorForcesAndMotionAreApart) {
  Scene scene = pulled("twintex-pw", 0.0, 1.0);
  scene.model.yarn = YarnElement::beam;
  EXPECT_FALSE(test::SmallWorld({scene})->moves_in_one_pass());
  EXPECT_FALSE(test::SmallWorld({test::drawing()})->moves_in_one_pass());
}

TEST(World, TakesTheStepOfThePlyThatNeedsTheShortest) {
  const Scene coarse = pulled("twintex-pw", 0.0, 1.0);
  Scene fine = coarse;
  fine.blank.coarsening = {2.0, 2.0};
  test::SmallWorld both({coarse, fine}), coarse_alone({coarse}), fine_alone({fine});
  for (auto* world : {&both, &coarse_alone, &fine_alone}) (*world)->start();
  EXPECT_EQ(both->step(), fine_alone->step());
  EXPECT_LT(both->step(), coarse_alone->step());
}

TEST(World, EnergiesAreThoseOfItsPliesTogether) {
  const Scene one = pulled("twintex-pw", 30.0, 3.0), other = pulled("twintex-tw", 45.0, 2.0);
  test::SmallWorld together({one, other}, shared_step), first({one}, shared_step), second({other}, shared_step);
  for (auto* world : {&together, &first, &second}) {
    world->run(400);
    (*world)->look_at_stored_energy();
  }
  EXPECT_GT(together->balance().external, 0.0);
  EXPECT_EQ(together->balance().internal, first->balance().internal + second->balance().internal);
  EXPECT_EQ(together->balance().kinetic, first->balance().kinetic + second->balance().kinetic);
  EXPECT_EQ(together->balance().external, first->balance().external + second->balance().external);
}

// A plate goes down on two pieces that lie side by side.
TEST(World, AToolFeelsAllPlies) {
  Scene left = test::contact_scene({60.0, 60.0}, 4.0);
  left.analysis.duration = duration;
  ToolSpec below = test::make_tool_spec("a_base", ToolShape::plane),
           above = test::make_tool_spec("b_press", ToolShape::plane);
  above.axis = {0.0, 0.0, -1.0};
  above.travel = 0.05;
  const double half = 0.5 * load_card(left.fabric.material).thickness;
  below.position = {0.0, 0.0, -half};
  above.position = {0.0, 0.0, half};
  left.tools = {below, above};
  Scene right = left;
  right.blank.position = {100.0, 0.0, 0.0};
  right.blank.size = {80.0, 60.0};
  test::SmallWorld both({left, right}, shared_step), left_alone({left}, shared_step), right_alone({right}, shared_step);
  for (auto* world : {&both, &left_alone, &right_alone}) world->run(2000);
  const auto force = [](test::SmallWorld& world) { return world->tools()->readings()[1].force; };
  EXPECT_GT(force(left_alone), 0.0);
  EXPECT_GT(force(right_alone), 0.0);
  EXPECT_DOUBLE_EQ(force(both), force(left_alone) + force(right_alone));
  EXPECT_EQ(state_digest(both->ply(1)), state_digest(right_alone->ply(0)));
}

TEST(World, GoesOnWithTheSameBitsAfterItsArchiveWasRead) {
  Scene scene = test::drawing();
  scene.model.cell = CellElement::shell;
  scene.analysis.step_bound = StepBound::reached;
  test::SmallWorld run({scene}), resumed({scene});
  run.run(300);
  const std::string kept = state_bytes(*run);
  StateReader reader(kept);
  resumed->archive(reader);
  EXPECT_EQ(reader.left(), 0U);
  EXPECT_EQ(state_digest(*resumed), state_digest(*run));
  run.run(300);
  resumed.run(300);
  EXPECT_EQ(state_digest(*resumed), state_digest(*run));
}

}  // namespace
}  // namespace weaveform
