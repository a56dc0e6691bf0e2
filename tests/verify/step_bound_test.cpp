// analysis.step_bound = "reached": far fewer steps, the same answers, the same energy balance.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/contact_scene.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

Scene bias_extension(const std::string& fabric, StepBound bound, const std::vector<std::string>& more = {}) {
  std::vector<std::string> overrides = {"fabric.material=" + fabric, "blank.coarsening=4", "output.frames=0",
                                        "analysis.step_bound=" + name_of(bound)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return test::example("bias_extension_pw", overrides);
}

// Load and angle differ by what steps and viscosity of another length leave of the yarns' vibration: 1e-3 and 0.02 deg
// are ten times what was measured for either fabric, and a tenth of what halving the loading speed changes.
TEST(StepBound, ReachedStrainsGiveTheSameBiasExtensionInAFractionOfTheSteps) {
  for (const std::string fabric : {"twintex-pw", "twintex-tw"}) {
    const test::Solved all(bias_extension(fabric, StepBound::stiffest)),
        reached(bias_extension(fabric, StepBound::reached));
    EXPECT_LT(reached.result.statistics.steps, all.result.statistics.steps / 4) << fabric;
    EXPECT_NEAR(reached.last("top.force_N"), all.last("top.force_N"), 1e-3 * all.last("top.force_N")) << fabric;
    EXPECT_NEAR(reached.last("center.shear_angle_deg"), all.last("center.shear_angle_deg"), 0.02) << fabric;
    EXPECT_LT(reached.result.statistics.energy_error, 1e-3) << fabric;
  }
}

// A law that is as stiff at zero strain as anywhere gives the bound nothing to follow.
TEST(StepBound, LinearYarnsTakeTheSameStepsToTheSameBits) {
  const std::vector<std::string> linear = {"model.yarn_law=linear", "grip.top.travel=3"};
  const test::Solved all(bias_extension("twintex-pw", StepBound::stiffest, linear)),
      reached(bias_extension("twintex-pw", StepBound::reached, linear));
  EXPECT_EQ(reached.result.statistics.steps, all.result.statistics.steps);
  EXPECT_EQ(reached.result.history.row, all.result.history.row);
}

// The hard case: yarns without any stiffness up to the slack strain and the full modulus beyond, and seatbelts that go
// slack; a step that followed each yarn's own tangent would be caught out by every snap.
TEST(StepBound, YarnsThatSnapTautKeepTheEnergyBalance) {
  for (const std::string yarn : {"truss", "seatbelt"}) {
    const test::Solved run(bias_extension("twintex-pw", StepBound::reached,
                                          {"model.yarn_law=slack", "model.yarn=" + yarn, "grip.top.travel=20"}));
    // one step of a snap is made before the step knows of it: 0.6 % measured, a tenth of the limit that stops a run
    EXPECT_LT(run.result.statistics.energy_error, 0.01) << yarn;
  }
}

TEST(StepBound, ReachedStrainsGiveTheSameDeepDrawing) {
  Scene scene = test::drawing();
  scene.analysis.step_bound = StepBound::stiffest;
  const SolveResult all = test::run(scene);
  scene.analysis.step_bound = StepBound::reached;
  scene.analysis.contact_stiffness = 1.0;
  const SolveResult reached = test::run(scene), threads = test::run(scene, 2);
  EXPECT_LT(reached.statistics.steps, all.statistics.steps);
  EXPECT_LT(reached.statistics.energy_error, 0.01);
  // 1 % of the greatest force: nodes slide on at other instants where the steps differ
  const double greatest = std::abs(all.history.values("punch.force_N").back());
  EXPECT_NEAR(reached.history.values("punch.force_N").back(), all.history.values("punch.force_N").back(),
              0.01 * greatest);
  EXPECT_NEAR(reached.statistics.max_shear_angle_deg, all.statistics.max_shear_angle_deg, 0.2);
  EXPECT_EQ(reached.history.row, threads.history.row) << "any number of threads, the same bits";
}

// Impulses of four steps are those of four forces for a part so soft; 0.5 % and 0.1 deg are what rounding moves in a
// drawing whose nodes slide. With the stiffest bound: this drawing bears little more than its inertia, and its force
// moves by more with the instants at which nodes slide on (docs/accuracy.md has the hemisphere with the other bound).
TEST(Subcycling, BendingEveryFourthStepGivesTheSameDeepDrawing) {
  Scene scene = test::drawing();
  scene.model.cell = CellElement::rotation_free;
  scene.analysis.step_bound = StepBound::stiffest;
  const SolveResult always = test::run(scene);
  scene.analysis.bending_every = 4;
  const SolveResult seldom = test::run(scene);
  const double force = always.history.values("punch.force_N").back();
  EXPECT_NEAR(seldom.history.values("punch.force_N").back(), force, 0.005 * std::abs(force));
  EXPECT_NEAR(seldom.statistics.max_shear_angle_deg, always.statistics.max_shear_angle_deg, 0.1);
  EXPECT_NEAR(seldom.statistics.bending_energy_mJ, always.statistics.bending_energy_mJ,
              0.02 * always.statistics.bending_energy_mJ);
  EXPECT_LT(seldom.statistics.energy_error, 2.0 * always.statistics.energy_error + 1e-3);
}

}  // namespace
}  // namespace weaveform
