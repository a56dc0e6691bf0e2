// What friction in bending lost has a column of its own in the history, and is part of all that was lost.
#include <gtest/gtest.h>

#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

// The cantilever of the examples, coarse and for a tenth of a second.
Scene hanging(bool with_friction) {
  Scene scene = test::example("cantilever_pw", {"blank.coarsening=2", "analysis.duration=0.1"});
  scene.output = {.frames = 0, .history = 20, .contour_step = 5.0};
  if (with_friction) scene.model.bending_friction = {{0.04, 0.002}};
  return scene;
}

TEST(BendingFrictionHistory, LossesGrowAndAreAPartOfAll) {
  for (const CellElement cell : {CellElement::rotation_free, CellElement::shell}) {
    Scene scene = hanging(true);
    scene.model.cell = cell;
    if (cell == CellElement::shell) scene.model.yarn = YarnElement::truss;
    const test::Solved run(scene);
    const auto lost = run.result.history.values("bending_friction_work_mJ");
    const auto all = run.result.history.values("damping_work_mJ");
    for (std::size_t n = 1; n < lost.size(); ++n) {
      EXPECT_GE(lost[n], lost[n - 1]);
      EXPECT_LE(lost[n], all[n]);
    }
    EXPECT_GT(lost.back(), 0.01 * all.back());
    EXPECT_EQ(run.result.statistics.bending_friction_work_mJ, lost.back());
  }
}

TEST(BendingFrictionHistory, WithoutFrictionThereIsNoColumn) {
  const test::Solved run(hanging(false));
  EXPECT_LT(run.result.history.index("bending_friction_work_mJ"), 0);
  EXPECT_EQ(run.result.statistics.bending_friction_work_mJ, 0.0);
}

}  // namespace
}  // namespace weaveform
