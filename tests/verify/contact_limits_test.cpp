// Where contact must not go on: each ends in a right answer or a clear stop, never in a plausible wrong picture.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <numbers>

#include "core/error.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/run_command.hpp"

namespace weaveform {
namespace {

using namespace test;

template <class Error>
std::string message_of(const Scene& scene) {
  try {
    (void)run(scene);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Drawing, RunsAndBalances) {
  const SolveResult result = run(drawing());
  EXPECT_LT(result.statistics.energy_error, 0.02);
  EXPECT_LT(result.statistics.contact_penetration, 0.3);
  EXPECT_GT(result.statistics.friction_work_mJ, 0.0);
  for (const double part : {0.05, 0.3, 0.6, 0.9, 1.0}) {
    const auto at = [&](const char* column) { return at_part(result.history, column, part); };
    EXPECT_NEAR(at("binder.force_N"), 50.0, 0.5) << part;
    EXPECT_NEAR(at("die.force_N"), at("binder.force_N") + at("punch.force_N"), 0.01 * at("die.force_N")) << part;
  }
}

// A perturbation displaces nodes that touch tools, with and without friction, before anything has moved: no work.
TEST(Drawing, BalancesFromAPerturbedStart) {
  for (const double friction : {0.0, 0.3}) {
    Scene scene = drawing();
    for (ToolSpec& tool : scene.tools) tool.friction = friction;
    scene.analysis.perturbation = 0.01;
    EXPECT_LT(run(scene).statistics.energy_error, 0.01) << "friction " << friction;
  }
}

TEST(Drawing, GivesTheSameBitsForAnyNumberOfThreads) {
  Scene scene = drawing();
  scene.tools[2].travel = 6.0;
  scene.analysis.loading_speed = 3000.0;
  const SolveResult one = run(scene, 1), two = run(scene, 2);
  EXPECT_EQ(one.position, two.position);
  EXPECT_EQ(one.history.row, two.history.row);
}

// A ball as text STL, its corners at the radius.
void write_ball(const std::filesystem::path& file, double radius, int rings) {
  constexpr double pi = std::numbers::pi;
  std::ofstream out(file);
  const auto vertex = [&](int i, int j) {
    const double a = pi * i / rings, b = pi * j / rings;
    out << "vertex " << radius * std::sin(a) * std::cos(b) << " " << radius * std::sin(a) * std::sin(b) << " "
        << radius * std::cos(a) << "\n";
  };
  const auto facet = [&](std::array<int, 2> p, std::array<int, 2> q, std::array<int, 2> r) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const auto& v : {p, q, r}) vertex(v[0], v[0] == 0 || v[0] == rings ? 0 : v[1] % (2 * rings));
    out << "endloop\nendfacet\n";
  };
  out << "solid ball\n" << std::setprecision(9);
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      if (i > 0) facet({i, j}, {i + 1, j}, {i, j + 1});
      if (i < rings - 1) facet({i, j + 1}, {i + 1, j}, {i + 1, j + 1});
    }
  out << "endsolid ball\n";
}

TEST(Drawing, PunchFromAnStlFileDrawsLikeItsFormula) {
  const TemporaryFolder folder;
  write_ball(folder.path() / "ball.stl", 20.0, 60);
  Scene scene = drawing();
  scene.analysis.loading_speed = 1000.0;
  const double smooth = run(scene).history.values("punch.force_N").back();
  scene.file = (folder.path() / "scene.toml").string();
  ToolSpec& punch = scene.tools[2];
  punch.shape = ToolShape::triangles;
  punch.radius.reset();
  punch.file = "ball.stl";
  punch.position = {{0.0, 0.0, 20.25}};
  // facets of 3 degrees lie up to 0.007 mm inside the ball, against a travel of 20 mm; the force grows some 8 times as
  // fast as the depth
  EXPECT_NEAR(run(scene).history.values("punch.force_N").back(), smooth, 0.01 * smooth);
}

// Mirrored and turned by a quarter: the square blank on round tools has the symmetry of the square.
TEST(Drawing, KeepsTheFourFoldSymmetry) {
  Scene scene = drawing();
  scene.model.symmetry = SymmetryUse::none;
  const Mesh mesh = build_mesh(scene, load_card(scene.fabric.material));
  const auto position = run(scene).position;
  double worst = 0.0;
  for (int a = 0; a < mesh.node_count(); ++a)
    for (int b = 0; b < mesh.node_count(); ++b) {
      const auto &p = mesh.nodes.position[a], &q = mesh.nodes.position[b];
      if (std::hypot(q[0] + p[1], q[1] - p[0]) > 1e-9) continue;  // b is a, turned
      worst = std::max(worst, std::hypot(position[b][0] + position[a][1], position[b][1] - position[a][0],
                                         position[b][2] - position[a][2]));
    }
  // order of sums differs between the turned copies: rounding, grown by slack yarns that choose a side to give way
  EXPECT_LT(worst, 1e-3);
}

TEST(Drawing, StartInsideAToolNamesNodeAndDepth) {
  Scene scene = drawing();
  scene.tools[2].position = {{0.0, 0.0, 19.0}};
  const std::string message = message_of<InputError>(scene);
  EXPECT_NE(message.find("[tools.punch]: node "), std::string::npos) << message;
  EXPECT_NE(message.find("starts 1.25 mm inside it"), std::string::npos) << message;
}

TEST(Drawing, ToolThatMovesMoreThanACellPerStepStops) {
  Scene scene = drawing();
  scene.tools[2].speed = {{0.0, 1.0}, {1.0, 1.0}};  // at once
  scene.analysis.loading_speed = 1e7;
  const std::string message = message_of<PhysicsError>(scene);
  EXPECT_NE(message.find("tool 'punch' moved"), std::string::npos) << message;
}

TEST(Drawing, TooFastAPunchStops) {
  Scene scene = drawing();
  scene.analysis.loading_speed = 2e6;
  EXPECT_NE(message_of<PhysicsError>(scene), "");
}

// The stiffest bound counts on every yarn being at its stiffest. A slack net can bear more, so a step above it may go
// well; then the answer must be right.
TEST(Drawing, TooLargeAStepStopsOrIsRight) {
  Scene stiffest = drawing();
  stiffest.analysis.step_bound = StepBound::stiffest;
  const double right = run(stiffest).history.values("punch.force_N").back();
  for (const double factor : {1.5, 2.0, 2.5, 3.0, 3.5, 4.0}) {
    Scene scene = stiffest;
    scene.analysis.step_factor = factor;
    EXPECT_NE(message_of<PhysicsError>(scene), "") << factor;  // refused unless asked not to check
    scene.analysis.step_check = false;
    try {
      EXPECT_NEAR(run(scene).history.values("punch.force_N").back(), right, 0.03 * right) << factor;
    } catch (const PhysicsError&) {
    }
  }
}

TEST(Drawing, TooLightABinderIsRefused) {
  Scene scene = drawing();
  scene.tools[0].mass = 1e-9;
  EXPECT_NE(message_of<InputError>(scene).find("too light for the stable step"), std::string::npos);
}

// Its guide is not what calms the binder: the contact's own damping is enough.
TEST(Drawing, BinderWithoutDampingOfItsOwnStillHoldsItsForce) {
  Scene scene = drawing();
  scene.tools[0].damping = 0.0;
  const SolveResult result = run(scene);
  EXPECT_LT(result.statistics.energy_error, 0.02);
  for (const double part : {0.05, 0.5, 1.0})
    EXPECT_NEAR(at_part(result.history, "binder.force_N", part), 50.0, 0.5) << part;
}

TEST(Drawing, PlatesThatCloseOnTheFabricStop) {
  Scene scene = contact_scene({60.0, 60.0}, 3.0);
  ToolSpec lower = make_tool_spec("lower", ToolShape::plane), upper = make_tool_spec("upper", ToolShape::plane);
  upper.axis = {0.0, 0.0, -1.0};
  upper.travel = 2.0;
  scene.tools = {lower, upper};
  const std::string message = message_of<PhysicsError>(scene);
  EXPECT_NE(message.find("more than the fabric's thickness"), std::string::npos) << message;
}

TEST(Drawing, SpeedTableReachesTheSameTravel) {
  Scene scene = drawing();
  scene.tools[2].speed = {{0.0, 0.0}, {0.2, 1.0}, {0.8, 1.0}, {1.0, 0.0}};
  const SolveResult result = run(scene);
  EXPECT_NEAR(result.history.values("punch.displacement_mm").back(), 20.0, 1e-9);
  // a trapezium of speed: at half the time half the way
  EXPECT_NEAR(at_part(result.history, "punch.displacement_mm", 0.5), 10.0, 0.05);
}

}  // namespace
}  // namespace weaveform
