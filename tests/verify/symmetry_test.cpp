// A half or quarter against the whole: the same answers, written for the whole.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "tests/support/contact_scene.hpp"
#include "tests/support/scene_run.hpp"

namespace weaveform {
namespace {

using namespace test;

struct Pair {
  SolveResult part, whole;
};

Pair solve_both(Scene scene) {
  const SolveResult part = run(scene);
  scene.model.symmetry = SymmetryUse::none;
  return {part, run(scene)};
}

double farthest(const std::vector<Vec3>& one, const std::vector<Vec3>& other) {
  double greatest = 0.0;
  for (std::size_t n = 0; n < one.size(); ++n)
    for (int c = 0; c < 3; ++c) greatest = std::max(greatest, std::abs(one[n][c] - other[n][c]));
  return greatest;
}

double greatest_of(const History& history, const std::string& column) {
  double greatest = 0.0;
  for (const double value : history.values(column)) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

// N; what the parts of a tool's force across its axis leave where they cancel: up to 2e-12 of it after these steps, to
// which 1e-16 has grown in the whole; 1e-10 leaves room for another compiler's sums.
double rounding_of(const History& history, const std::string& column) {
  for (const char* across : {".force_x_N", ".force_y_N"})
    if (const auto tool = column.find(across); tool != std::string::npos)
      return 1e-10 * greatest_of(history, column.substr(0, tool) + ".force_z_N");
  return 0.0;
}

// Every column, each measured by its own greatest value. Columns whose rows are ratios of next to nothing at the start
// (energy_error) or count nodes that touch by a rounding error (contact area at the start) are left out.
void expect_same_history(const History& part, const History& whole, double tolerance, const std::string& name) {
  ASSERT_EQ(part.column, whole.column) << name;
  ASSERT_EQ(part.row.size(), whole.row.size()) << name;
  for (const auto& column : whole.column) {
    if (column == "energy_error" || column.find("contact_area") != std::string::npos) continue;
    const auto a = part.values(column), b = whole.values(column);
    const double scale = std::max(1e-3, greatest_of(whole, column));  // what is zero has no scale of its own
    const double bound = std::max(tolerance * scale, rounding_of(whole, column));
    for (std::size_t r = 0; r < a.size(); ++r)
      EXPECT_NEAR(a[r], b[r], bound) << name << ": " << column << ", row " << r;
  }
}

// 2 to 3 thousand steps: long enough to press, slide and shear, too short for rounding to grow from 1e-16 past 1e-9. With
// the stiffest bound, which takes the same steps whatever rounding does to the strains that were reached.
TEST(Symmetry, AQuarterIsTheWholeToRounding) {
  const std::vector<std::pair<std::string, std::function<void(Scene&)>>> cases = {
      {"lines in the planes", [](Scene&) {}},
      {"planes midway between lines",
       [](Scene& s) {
         s.blank.phase = {0.5, 0.5};
       }},
      {"yarns at 45 deg", [](Scene& s) { s.blank.yarn_angle = 45.0; }},
      {"yarns at 45 deg, free ends across the planes",
       [](Scene& s) {
         s.blank.yarn_angle = 45.0;
         s.blank.phase = {0.5, 0.5};
       }},
      {"turned and elsewhere",
       [](Scene& s) {
         s.blank.orientation = 30.0, s.blank.position = {11.0, -7.0, 3.0};
       }},
      {"beams and cells that bend",
       [](Scene& s) {
         s.model.yarn = YarnElement::beam;
         s.model.yarn_bending = {{300.0, 200.0}};
         s.model.cell = CellElement::rotation_free;
         s.model.cell_bending = {{30.0, 40.0, 20.0}};
       }},
      {"incremental", [](Scene& s) { s.model.formulation = Formulation::incremental; }},
      {"contravariant, under its weight",
       [](Scene& s) {
         s.model.formulation = Formulation::contravariant;
         s.analysis.gravity = {0.0, 0.0, -9810.0};
       }},
  };
  for (const auto& [name, change] : cases) {
    Scene scene = drawing();
    scene.tools[2].travel = 6.0;
    scene.analysis.loading_speed = 1200.0;
    scene.output.history = 20;
    scene.analysis.step_bound = StepBound::stiffest;
    change(scene);
    scene.measure = {{.name = "corner", .box = {{-55.0, -55.0, -20.0, -20.0}}, .relative_box = {}},
                     {.name = "side", .box = {{5.0, -40.0, 30.0, -10.0}}, .relative_box = {}}};
    const auto [part, whole] = solve_both(scene);
    EXPECT_EQ(part.statistics.symmetry, "quarter") << name;
    EXPECT_EQ(whole.statistics.symmetry, "none") << name;
    EXPECT_EQ(part.statistics.cells, whole.statistics.cells) << name;
    EXPECT_LT(part.statistics.cells_solved, 0.4 * whole.statistics.cells_solved) << name;
    EXPECT_EQ(part.statistics.steps, whole.statistics.steps) << name;
    EXPECT_NEAR(part.statistics.friction_work_mJ, whole.statistics.friction_work_mJ,
                1e-8 * whole.statistics.friction_work_mJ)
        << name;
    EXPECT_NEAR(part.statistics.max_shear_angle_deg, whole.statistics.max_shear_angle_deg, 1e-7) << name;
    EXPECT_LT(farthest(part.position, whole.position), 1e-7) << name;
    expect_same_history(part.history, whole.history, 1e-7, name);
    // the sign of the angle is that of its own corner of the blank
    const double corner = part.history.values("corner.shear_angle_deg").back();
    const double side = part.history.values("side.shear_angle_deg").back();
    if (scene.blank.yarn_angle == 0.0) {
      EXPECT_LT(corner * side, 0.0) << name;
    }
  }
}

// To the end of the stroke: slack yarns choose a side to give way by rounding, in the whole as in the quarter
// (contact_limits_test: the whole keeps its own symmetry within 1e-3 mm). Measured here: 2e-8 of the force, 4e-6 mm.
TEST(Symmetry, AQuarterDrawsLikeTheWhole) {
  const auto [part, whole] = solve_both(drawing());
  EXPECT_EQ(part.statistics.symmetry, "quarter");
  EXPECT_LT(farthest(part.position, whole.position), 1e-3);
  const auto force = whole.history.values("punch.force_N"), of_part = part.history.values("punch.force_N");
  for (std::size_t r = 0; r < force.size(); ++r) EXPECT_NEAR(of_part[r], force[r], 1e-5 * force.back()) << "row " << r;
  EXPECT_NEAR(part.statistics.max_shear_angle_deg, whole.statistics.max_shear_angle_deg, 1e-3);
  EXPECT_NEAR(part.history.values("internal_energy_mJ").back(), whole.history.values("internal_energy_mJ").back(),
              1e-5 * whole.history.values("internal_energy_mJ").back());
  EXPECT_NEAR(part.history.values("punch.contact_area_mm2").back(),
              whole.history.values("punch.contact_area_mm2").back(),
              1e-9 * whole.history.values("punch.contact_area_mm2").back());
  EXPECT_LT(part.statistics.energy_error, 0.02);
  // the binder is pushed by the whole force
  EXPECT_NEAR(at_part(part.history, "binder.force_N", 0.5), 50.0, 0.5);
}

TEST(Symmetry, AHalfDrawsLikeTheWhole) {
  Scene scene = drawing();
  scene.tools[2].travel = 6.0;
  scene.analysis.loading_speed = 1200.0;
  for (const bool forced : {true, false}) {
    if (forced)
      scene.model.symmetry = SymmetryUse::half;
    else {  // gravity along x leaves y = 0 alone
      scene.model.symmetry = SymmetryUse::automatic;
      scene.analysis.gravity = {2000.0, 0.0, 0.0};
    }
    const auto [part, whole] = solve_both(scene);
    EXPECT_EQ(part.statistics.symmetry, "half");
    EXPECT_LT(farthest(part.position, whole.position), 1e-7);
    expect_same_history(part.history, whole.history, 1e-7, forced ? "forced" : "gravity");
  }
}

// The mirror x = 0 swaps the families, y = 0 the grips: each grip's force is its own and its image's.
TEST(Symmetry, BiasExtensionsPulledAtOneOrBothEndsAgree) {
  Scene scene =
      example("bias_extension_pw", {"blank.coarsening=4", "output.history=20", "analysis.step_bound=stiffest"});
  for (const bool both : {false, true}) {
    if (both) scene.grip[0].travel = scene.grip[1].travel = 15.0;
    scene.model.symmetry = SymmetryUse::automatic;
    const Solved part(scene);
    scene.model.symmetry = SymmetryUse::none;
    const Solved whole(scene);
    EXPECT_EQ(part.result.statistics.symmetry, both ? "quarter" : "half");
    expect_same_history(part.result.history, whole.result.history, 1e-9, both ? "both ends" : "one end");
    EXPECT_LT(farthest(part.result.position, whole.result.position), 1e-8);
  }
}

TEST(Symmetry, MessagesCallNodesByTheirNumberInTheWhole) {
  Scene scene = drawing();
  scene.tools[2].position = {{0.0, 0.0, 19.0}};
  const Mesh mesh = build_mesh(scene, load_card(scene.fabric.material));
  int centre = -1;
  for (int n = 0; n < mesh.node_count(); ++n)
    if (std::hypot(mesh.nodes.position[n][0], mesh.nodes.position[n][1]) < 1e-9) centre = n;
  try {
    (void)run(scene);
    FAIL() << "the punch starts in the fabric";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("node " + std::to_string(centre) + " at (0, 0, 0)"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace weaveform
