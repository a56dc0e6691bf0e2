// Bending against closed forms: every case of tests/support/bending_cases.hpp at its order, and the program's own
// cantilever against the heavy elastica.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "core/files/files.hpp"
#include "solver/bending/bending_energy.hpp"
#include "solver/bending/shell_energy.hpp"
#include "tests/support/bending_cases.hpp"
#include "tests/support/cantilever_strip.hpp"
#include "tests/support/elastica.hpp"
#include "tests/support/fabric_patch.hpp"
#include "tests/support/trust.hpp"

namespace weaveform {
namespace {

using test::Bender;
using test::BendingCase;
using test::Measured;

constexpr double at_rest = 1e-9;  // N, N mm; rounding leaves 1e-10 of forces of 1e-4 to 1

// Errors at cell counts that double, coarsest first.
std::vector<double> errors(Measured (*run)(Bender, int), Bender bender, int doublings) {
  std::vector<double> found;
  for (int k = 0, cells = bender == Bender::yarn ? 8 : 6; k <= doublings; ++k, cells *= 2) {
    const Measured m = run(bender, cells);
    EXPECT_LT(m.residual, at_rest) << cells << " cells";
    found.push_back(m.error);
  }
  return found;
}

struct OfSecondOrder {
  Measured (*run)(Bender, int);
  std::vector<Bender> benders;
  double
      coarsest;  // 1; error allowed to a strip of 6 cells: 1/36 for the trapezoid rule of the sag, less than that else
};

// Halving the cells divides the error by 4; third and higher orders move that by less than a fifth on these meshes.
TEST(BendingClosedForms, ErrorsFallWithTheSquareOfTheCells) {
  constexpr auto yarn = Bender::yarn, beam = Bender::beam, free = Bender::rotation_free, shell = Bender::shell;
  const std::vector<OfSecondOrder> cases = {
      {&test::sag, {yarn, beam, free}, 0.028},
      {&test::heavy_elastica, {yarn, beam, free, shell}, 0.021},
      {&test::peirce_overhang, {yarn, beam, free, shell}, 0.021},
      {&test::end_loaded_elastica, {yarn, beam, free, shell}, 0.016},
      {&test::euler_pinned, {yarn}, 0.013},
      {&test::euler_clamped, {yarn}, 0.0033},
      {&test::short_thick_strip, {shell}, 0.004},
      {&test::cut_strip, {beam, free, shell}, 0.018},
  };
  for (std::size_t k = 0; k < cases.size(); ++k)
    for (const Bender bender : cases[k].benders) {
      const auto error = errors(cases[k].run, bender, bender == Bender::yarn ? 2 : 1);
      EXPECT_LT(error.front(), cases[k].coarsest) << "case " << k << ", " << name_of(bender);
      for (std::size_t n = 1; n < error.size(); ++n)
        EXPECT_NEAR(error[n - 1] / error[n], 4.0, 0.8) << "case " << k << ", " << name_of(bender);
    }
}

// A chain of N yarn elements under its own weight is the trapezoid rule: exactly w L^4/8B (1 + 1/N^2).
TEST(BendingClosedForms, TheSagOfAYarnIsThatOfTheTrapezoidRule) {
  for (const int cells : {8, 32}) {
    const Measured m = test::sag(Bender::yarn, cells);
    EXPECT_NEAR(m.measured / m.exact, 1.0 + 1.0 / (cells * cells), 2e-6);  // deflection^2: (1/800)^2
  }
}

// Euler's load of N pinned elements is (2 N sin(pi/2N)/pi)^2 of the continuous one.
TEST(BendingClosedForms, TheEulerLoadOfAYarnIsThatOfTheChain) {
  const double x = 0.5 * std::numbers::pi / 16;
  const Measured m = test::euler_pinned(Bender::yarn, 16);
  EXPECT_NEAR(m.measured / m.exact, std::pow(std::sin(x) / x, 2), 1e-6);
}

// Shells are exact at the nodes where loads at nodes bend them a little: linear directors, shear at the middles.
TEST(BendingClosedForms, AShellsSagIsExactAtItsNodes) {
  EXPECT_LT(test::sag(Bender::shell, 6).error, 2e-6);  // deflection^2
}

// Chords of equal turns close exactly; what is left is the turn's series, of eighth order.
TEST(BendingClosedForms, PureBendingClosesTheCircle) {
  for (const Bender bender : {Bender::yarn, Bender::shell}) {
    const auto error = errors(&test::full_circle, bender, 1);
    EXPECT_LT(error[0], 2e-3);
    EXPECT_GT(error[0] / error[1], 200.0);
  }
}

// Twist is constant over the plate, so that every mesh has it exactly; a shell with what its edges shear.
TEST(BendingClosedForms, CornerForcesTwistASquarePlate) {
  for (const int cells : {3, 6, 12}) {
    EXPECT_LT(test::plate_twist(Bender::rotation_free, cells).error, 1e-8);
    EXPECT_LT(test::plate_twist(Bender::shell, cells).error, 1e-6);
  }
}

// A law that yields moves the error with its own curvature; still of second order.
TEST(BendingClosedForms, AYieldingYarnAndStripFollowTheirLaw) {
  for (const Bender bender : {Bender::yarn, Bender::rotation_free, Bender::shell}) {
    const auto error = errors(&test::yielding_strip, bender, 1);
    EXPECT_LT(error[0], 0.03) << name_of(bender);
    EXPECT_LT(error[1], 0.35 * error[0]) << name_of(bender);
  }
}

// The same strip of fabric at coarsening 4, 2 and 1 (6, 12 and 24 cells): what differs is of second order alone, so
// that Richardson's extrapolation from two of them is the closed form (fourth order is left: 1e-3 of 6 cells' error).
TEST(BendingClosedForms, CoarseningLeavesAStripAsStiffAndAsHeavy) {
  for (const Bender bender : {Bender::beam, Bender::rotation_free}) {
    const Measured four = test::heavy_elastica(bender, 6), two = test::heavy_elastica(bender, 12),
                   one = test::heavy_elastica(bender, 24);
    EXPECT_NEAR((4.0 * two.measured - four.measured) / 3.0, four.exact, 5e-4 * four.exact) << name_of(bender);
    EXPECT_NEAR((4.0 * one.measured - two.measured) / 3.0, four.exact, 5e-5 * four.exact) << name_of(bender);
  }
}

// w = kappa x^2/2 over a blank cut at 45 deg to its yarns: E = A (D1 k1^2 + D2 k2^2 + 4 D66 k12^2)/2 with k1 = k2 = k12
// = kappa/2. Yarns at the corners too short for a bend leave 3 % of the rotation-free energy at this size, and a
// quarter of that at twice the size; bends that stop short of the cut edges would leave a part of first order.
TEST(BendingClosedForms, AUniformCurvatureHasItsEnergyUpToTheCutEdges) {
  constexpr double rigidity = 2.0, twist = 0.2, kappa = 1e-3;
  std::vector<double> error;
  for (const double size : {1.0, 2.0}) {
    const test::FabricPatch patch("twintex-pw", 45.0, {60.0 * size, 120.0 * size});
    std::vector<Vec3> position, director;
    for (const auto& x : patch.mesh.nodes.position) {
      const double tilt = 1.0 / std::sqrt(1.0 + kappa * kappa * x[0] * x[0]);
      position.push_back({x[0], x[1], 0.5 * kappa * x[0] * x[0]});
      director.push_back({-kappa * x[0] * tilt, 0.0, tilt});
    }
    const TangentLaw law({{0.0, std::numeric_limits<double>::infinity(), {rigidity * patch.card.yarn[0].interval}}});
    Flexure flexure;
    flexure.out_of_plane = flexure.shell = {law, law};
    const double area = 60.0 * 120.0 * size * size;
    const double exact = 0.25 * area * rigidity * kappa * kappa, exact_twist = 0.5 * area * twist * kappa * kappa;
    const std::vector<char> none(patch.mesh.node_count(), 0);
    error.push_back(1.0 - bending_energy(find_bends(patch.mesh, none), flexure, position) / exact);
    // slopes: kappa^2 x^2, 1e-3 at the edge
    EXPECT_NEAR(shell_energy(find_shell_edges(patch.mesh, patch.card, 0.0), {}, flexure, patch.mesh.spacing, position,
                             director),
                exact, 0.004 * exact);
    EXPECT_NEAR(twist_energy(find_twist_cells(patch.mesh), twist, patch.mesh.spacing, position), exact_twist,
                0.004 * exact_twist);
  }
  EXPECT_NEAR(error[0], 0.0, 0.03);
  EXPECT_NEAR(error[1], 0.0, 0.3 * error[0]);
}

// The integration that meshes are compared with, against elliptic integrals (Bisshopp & Drucker 1945): with k^2 = (1 +
// sin tip)/2 and sin phi = 1/(k sqrt 2), P L^2/B = (K(k) - F(k, phi))^2.
TEST(Elastica, ShootingAgreesWithEllipticIntegrals) {
  const test::Rod rod{.length = 1.0, .curvature = [](double moment) { return moment; }, .end_load = 12.0};
  const double tip = test::solve_rod(rod).angle.back();
  EXPECT_GT(tip, 80.0 * std::numbers::pi / 180.0);
  const double k = std::sqrt(0.5 * (1.0 + std::sin(tip)));
  const double root = std::comp_ellint_1(k) - std::ellint_1(k, std::asin(1.0 / (k * std::numbers::sqrt2)));
  EXPECT_NEAR(root * root, 12.0, 1e-9);
}

// Peirce's rule, overhang = 2 c at 41.5 deg, is that of the heavy elastica: 2.0003 c.
TEST(Elastica, PeirceOverhangIsTwiceTheBendingLength) {
  EXPECT_NEAR(std::cbrt(test::peirce_load()), 2.0, 0.001);
}

// The program's dynamic settling. The tip is judged against the inextensible heavy elastica: 26 cells leave 0.1 % of
// the length (the table of docs/elements.md), the card's slack yarns 0.2 %, what is left of the motion less.
TEST(CantileverScene, TheTipHangsWhereTheHeavyElasticaDoes) {
  const test::Solved run(test::example("cantilever_pw", {"model.yarn_stiffness_scale=0.1"}));  // a third of the steps
  const double length = run.scene.blank.size[0], width = run.scene.blank.size[1];
  test::Rod rod{.length = length, .curvature = {}};
  rod.weight = run.card.area_density() * 9810.0;
  rod.curvature = [d = (*run.card.bending.rigidity)[0]](double moment) { return moment / d; };
  const auto shape = test::solve_rod(rod);
  const test::StripTip tip = test::tip_of(run);
  ASSERT_NEAR(tip.along, length, 1e-3 * length);
  EXPECT_NEAR(tip.x, shape.x_at(tip.along), 0.005 * length);
  EXPECT_NEAR(tip.drop, shape.drop_at(tip.along), 0.005 * length);
  RecordProperty("tip_x_mm", std::to_string(tip.x) + " of " + std::to_string(shape.x_at(tip.along)));
  RecordProperty("tip_drop_mm", std::to_string(tip.drop) + " of " + std::to_string(shape.drop_at(tip.along)));
  // at rest: the kinetic energy of the end against the weight's work
  EXPECT_LT(run.last("kinetic_energy_mJ"), 1e-6 * rod.weight * width * length * shape.drop.back());
}

// A strip whose yarns are 50 times as stiff at first as they are under its weight.
constexpr double strip_stiff = 500.0, strip_soft = 10.0, strip_knee = 1e-4;  // N mm^2, N mm^2, 1/mm
test::StripWithLaw softening_strip() {
  return test::StripWithLaw(
      fmt::format("bending_out_of_plane = [{{ from = 0.0, to = {}, coefficients = [{}] }}, {{ from = {}, "
                  "coefficients = [{}] }}]",
                  strip_knee, strip_stiff, strip_knee, strip_soft));
}

TEST(CantileverScene, AStripWhoseLawSoftensHangsWhereTheElasticaDoesToo) {
  const test::StripWithLaw strip = softening_strip();
  const test::Solved run = strip.run({"blank.size=[128, 15]"});
  const double length = run.scene.blank.size[0], interval = run.card.yarn[0].interval;
  test::Rod rod{.length = length, .curvature = {}};
  rod.weight = run.card.area_density() * 9810.0;
  rod.curvature = [&](double moment) {  // per width
    const double m = std::abs(moment) * interval, first = strip_stiff * strip_knee;
    const double curvature = m < first ? m / strip_stiff : strip_knee + (m - first) / strip_soft;
    return std::copysign(curvature, moment);
  };
  const auto shape = test::solve_rod(rod);
  const test::StripTip tip = test::tip_of(run);
  EXPECT_GT(shape.drop.back(), 0.4 * length);
  EXPECT_NEAR(tip.x, shape.x_at(tip.along), 0.01 * length);
  EXPECT_NEAR(tip.drop, shape.drop_at(tip.along), 0.01 * length);
  EXPECT_TRUE(test::warnings_of(run).empty());
}

TEST(CantileverScene, AStripThatIsStoppedOnItsWaySaysSo) {
  const test::StripWithLaw strip = softening_strip();
  const std::vector<std::string> hasty = {"analysis.duration=0.153", "analysis.damping=157", "blank.coarsening=2"};
  EXPECT_TRUE(test::says(test::warnings_of(strip.run(hasty)), "has not come to rest"));
}

}  // namespace
}  // namespace weaveform
