// An analysis that its caller steps: nothing changes by that, and what he adds counts.
#include "solver/analysis/steered.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "core/vector/append.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/resolve/resolve.hpp"
#include "solver/solve.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/contact_scene.hpp"

namespace weaveform {
namespace {

Scene steered_scene(double travel) {
  Scene scene = test::contact_scene({80.0, 120.0}, 3.0);
  scene.fabric.material = "twintex-pw";
  scene.blank.yarn_angle = 45.0;
  scene.analysis.duration = 0.02;
  scene.output.history = 40;
  for (const char* edge : {"bottom", "top"}) {
    GripSpec grip;
    grip.name = edge;
    grip.edge = test::chosen(edge);
    grip.travel = grip.name == "top" ? travel : 0.0;
    scene.grip.push_back(grip);
  }
  return scene;
}

Resolved steered_model(const Scene& scene) {
  const Card card = load_card(scene.fabric.material);
  return resolve_around(scene, card, build_mesh(scene, card));
}

void step_to_the_end(Steered& run) {
  while (!run.ended()) run.step();
}

TEST(Steered, StepsAreThoseOfARun) {
  for (const auto formulation : {Formulation::energy, Formulation::contravariant, Formulation::incremental}) {
    Scene scene = steered_scene(4.0);
    scene.model.formulation = formulation;
    scene.analysis.mass_scale = 1.5;
    const Resolved model = steered_model(scene);
    const SolveResult whole = solve(model, {}, {.threads = 1, .quiet = true});
    Steered run(model, 2);
    step_to_the_end(run);
    EXPECT_TRUE(run.world().finished());
    EXPECT_EQ(run.history().row, whole.history.row);
    EXPECT_EQ(run.closed_rows(), whole.history.row.size());
    EXPECT_EQ(run.world().ply(0).whole_positions(), whole.position);
    EXPECT_EQ(run.world().steps(), whole.statistics.steps);
    EXPECT_THROW(run.step(), Interrupted);
  }
}

// Two plies drawn, a quarter of them solved; loads that are nothing are asked for on both.
TEST(Steered, StepsOfAStackAreThoseOfARun) {
  Findings found;
  const Resolved model = resolve(
      std::string(WEAVEFORM_SOURCE_DIR) + "/examples/hemisphere_two_plies.toml",
      {"blank.coarsening=6", "tools.punch.travel=5", "analysis.duration=0.005", "output.frames=0", "output.history=10"},
      found);
  found.throw_if_any();
  const SolveResult whole = solve(model, {}, {.threads = 1, .quiet = true});
  Steered run(model, 1);
  for (const std::size_t ply : {0U, 1U}) EXPECT_EQ(run.load(ply).size(), run.world().ply(ply).mesh().nodes.mass.size());
  EXPECT_NE(&run.load(0), &run.load(1));
  step_to_the_end(run);
  EXPECT_EQ(run.history().row, whole.history.row);
  std::vector<Vec3> all = run.world().ply(0).whole_positions();
  append(all, run.world().ply(1).whole_positions());
  EXPECT_EQ(all, whole.position);
}

TEST(Steered, HistoryOfAnEarlyEndIsTheBeginningOfTheWhole) {
  const Resolved model = steered_model(steered_scene(4.0));
  const SolveResult whole = solve(model, {}, {.threads = 1, .quiet = true});
  Steered run(model, 1);
  while (run.world().time() < 0.5 * run.world().duration()) run.step();
  const std::size_t known = run.closed_rows();
  run.end();
  EXPECT_TRUE(run.ended());
  EXPECT_FALSE(run.world().finished());
  EXPECT_GT(known, 10U);
  EXPECT_GE(run.closed_rows(), known);
  EXPECT_EQ(run.closed_rows(), run.history().row.size());
  for (std::size_t k = 0; k < known; ++k) EXPECT_EQ(run.history().row[k], whole.history.row[k]);
  EXPECT_THROW(run.step(), Interrupted);
}

TEST(Steered, WorkOfALoadIsTheEnergyThereIs) {
  Scene scene = steered_scene(0.0);
  scene.model.symmetry = SymmetryUse::none;
  Steered run(steered_model(scene), 1);
  auto& load = run.load();
  ASSERT_EQ(load.data(), run.load().data());
  const auto before = run.world().ply(0).positions();
  while (!run.ended()) {
    for (auto& force : load) force[0] = 0.02 * std::min(1.0, 2.0 * run.world().time() / run.world().duration());
    run.step();
  }
  const EnergyBalance& energy = run.world().balance();
  EXPECT_GT(energy.external, 1e-3);
  EXPECT_NEAR(energy.internal + energy.kinetic + energy.damping, energy.external, 0.01 * energy.external);
  double moved = 0.0;
  const auto after = run.world().ply(0).positions();
  for (std::size_t n = 0; n < after.size(); ++n) moved = std::max(moved, after[n][0] - before[n][0]);
  EXPECT_GT(moved, 0.01);
}

TEST(Steered, AFailureIsToldAtEveryFurtherStep) {
  Scene scene = steered_scene(60.0);
  scene.analysis.duration = 1e-4;
  Steered run(steered_model(scene), 1);
  std::string first, second;
  try {
    step_to_the_end(run);
  } catch (const PhysicsError& error) {
    first = error.what();
  }
  ASSERT_FALSE(first.empty());
  try {
    run.step();
  } catch (const PhysicsError& error) {
    second = error.what();
  }
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace weaveform
