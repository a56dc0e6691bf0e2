// The shear-frame scene against Eqs. 12 and 13, and the incremental formulation against its closed form in the unit
// cell.
#include "fabric/trellis/shear_frame.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/vector/angle.hpp"
#include "mesher/resolve/resolve.hpp"
#include "post/measure/frame_comparison.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/scene_run.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform {
namespace {

using test::example;
using test::Solved;

struct Worst {
  double load = 0.0;    // 1; relative to `expected(angle)`
  double angle = 0.0;   // deg; fabric's mean from Eq. 12
  double spread = 0.0;  // deg; standard deviation over the fabric
};

// Over frame angles of 5 to 50 deg.
template <class Expected>
Worst worst_of(const Solved& solved, const Expected& expected) {
  const ShearFrame frame{solved.scene.frame->length, solved.scene.blank.size[0]};
  const auto travel = solved.result.history.values("crosshead.displacement_mm");
  const auto load = solved.result.history.values("crosshead.force_N");
  const auto angle = solved.result.history.values("fabric.shear_angle_deg");
  const auto spread = solved.result.history.values("fabric.shear_angle_sd_deg");
  Worst worst;
  for (std::size_t k = 1; k < travel.size(); ++k) {
    const double gamma = frame_shear_angle(frame, travel[k]);
    if (gamma < 5.0 * degree || gamma > 50.0 * degree) continue;
    worst.load = std::max(worst.load, std::abs(load[k] / frame_load(frame, expected(gamma), gamma) - 1.0));
    worst.angle = std::max(worst.angle, std::abs(angle[k] - gamma / degree));
    worst.spread = std::max(worst.spread, spread[k]);
  }
  return worst;
}

double normalised_force(const Card& card, double gamma) {
  return card.thickness * shear_stress(card.shear, std::atanh(std::sin(gamma)));
}

// The tests' scenes are the examples on coarser meshes; the uniform field does not care (the examples' own figures are
// in docs/shear_frame.md).
class ShearFrameFabrics : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, ShearFrameFabrics, testing::Values("shear_frame_pw", "shear_frame_tw"));

TEST_P(ShearFrameFabrics, LoadAndAngleAreThoseOfEqs12And13) {
  const Solved solved(example(
      GetParam(), {std::string(GetParam()) == "shear_frame_pw" ? "blank.coarsening=4" : "blank.coarsening=[8,4]"}));
  const Worst worst = worst_of(solved, [&](double gamma) { return normalised_force(solved.card, gamma); });
  EXPECT_LT(worst.load, 0.01);
  EXPECT_LT(worst.angle, 0.2);
  EXPECT_LT(worst.spread, 0.2);
  EXPECT_EQ(solved.result.statistics.folded_cells, 0);
  EXPECT_LT(solved.result.statistics.energy_error, 0.001);
}

TEST(ShearFrame, RigidAndDeformableFramesAgree) {
  const std::vector<std::string> common = {"blank.coarsening=4", "output.history=40", "analysis.duration=0.4"};
  const Solved trusses(example("shear_frame_pw", common));
  Scene rigid_scene = trusses.scene;
  rigid_scene.frame->rigid = true;
  const Solved rigid(rigid_scene);
  const auto a = trusses.result.history.values("crosshead.force_N"),
             b = rigid.result.history.values("crosshead.force_N");
  // 50 N stretch a member of 3.5e7 N by 1e-6; what differs is the 12 g of the members
  for (std::size_t k = 4; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 0.02 * std::abs(b[k]) + 0.01) << "row " << k;
  EXPECT_NEAR(trusses.last("fabric.shear_angle_deg"), rigid.last("fabric.shear_angle_deg"), 0.01);
}

// A frame shears all plies alike, so that none slides on another: their loads add up, whatever the friction.
class StackInAFrame : public testing::Test {
protected:
  static Scene framed(const std::string& material, std::array<double, 2> coarsening) {
    Scene scene = example("shear_frame_pw", {"output.history=40", "analysis.duration=0.2", "frame.rigid=true",
                                             "output.frames=0", "frame.mass_scale=1e-6"});
    scene.fabric.material = material;
    scene.blank.coarsening = coarsening;
    return scene;
  }
  // Of the scenes' fabrics, the upper one turned by a quarter.
  [[nodiscard]] Resolved stacked(const Scene& lower, const Scene& upper, double gap, double friction) const {
    Scene scene = lower;
    scene.ply.push_back(
        {.name = "lower", .fabric = lower.fabric, .blank = lower.blank, .model = lower.model, .position = {}});
    scene.ply.push_back(
        {.name = "upper", .fabric = upper.fabric, .blank = upper.blank, .model = upper.model, .position = {}});
    scene.ply[1].blank.yarn_angle += 90.0;
    scene.stack.gap = gap;
    scene.stack.friction = friction;
    test::write_text(scene_to_toml(scene), folder_.path() / "stack.toml");
    Findings found;
    Resolved model = resolve(folder_.path() / "stack.toml", {}, found);
    found.throw_if_any();
    return model;
  }
  [[nodiscard]] static SolveResult solved(const Resolved& model) {
    return solve(model, {}, {.threads = 1, .resume = false, .quiet = true});
  }
  test::TemporaryFolder folder_;
};

TEST_F(StackInAFrame, PliesApartCarryTwiceTheLoadOfOne) {
  const Scene one = framed("twintex-pw", {6.0, 6.0});
  const auto alone = Solved(one).result.history.values("crosshead.force_N"),
             both = solved(stacked(one, one, 1.0, 0.0)).history.values("crosshead.force_N");
  ASSERT_EQ(both.size(), alone.size());
  for (std::size_t k = 1; k < both.size(); ++k) EXPECT_NEAR(both[k], 2.0 * alone[k], 1e-6 * std::abs(alone.back()));
}

TEST_F(StackInAFrame, UnlikePliesThatRubCarryTheSumAndDoNotSlide) {
  const Scene plain = framed("twintex-pw", {6.0, 6.0}), twill = framed("twintex-tw", {8.0, 4.0});
  const Solved lower(plain), upper(twill);
  const Resolved model = stacked(plain, twill, 0.0, 0.3);
  const SolveResult both = solved(model);
  const auto a = lower.result.history.values("crosshead.force_N"), b = upper.result.history.values("crosshead.force_N"),
             sum = both.history.values("crosshead.force_N");
  for (std::size_t k = 4; k < sum.size(); ++k)
    EXPECT_NEAR(sum[k], a[k] + b[k], 0.01 * std::abs(a[k] + b[k]) + 0.01) << "row " << k;
  EXPECT_LT(both.history.values("lower/upper.slip_mm").back(), 0.05);
  EXPECT_LT(both.statistics.energy_error, 0.001);
  const std::vector<const Card*> cards = {&model.ply[0].card, &model.ply[1].card};
  const Scene& frame = model.ply[0].scene;
  EXPECT_DOUBLE_EQ(compare_shear_frame(frame, cards, both.history).ideal_load,
                   compare_shear_frame(frame, {cards[0]}, both.history).ideal_load +
                       compare_shear_frame(frame, {cards[1]}, both.history).ideal_load);
}

TEST(ShearFrame, TheIncrementalFormulationDiffersByWhatTheUnitCellSays) {
  const Solved solved(example("shear_frame_pw", {"blank.coarsening=4", "model.formulation=incremental"}));
  const auto& law = solved.card.shear.tangent;
  const Worst worst = worst_of(solved, [&](double gamma) {
    // normal stresses of Eq. 10: integral of sin(gamma') C d(gamma_L'), by the trapezoidal rule (error 1e-7)
    const double end = std::atanh(std::sin(gamma));
    constexpr int intervals = 2000;
    double normal = 0.0;
    for (int n = 0; n <= intervals; ++n) {
      const double g = end * n / intervals;
      normal += (n == 0 || n == intervals ? 0.5 : 1.0) * std::tanh(g) * law.tangent(g) * end / intervals;
    }
    const double cosine = std::cos(gamma);
    return solved.card.thickness * (law.stress(end) - std::sin(gamma) * normal) / (cosine * cosine);
  });
  EXPECT_LT(worst.load, 0.015);
  EXPECT_LT(worst.angle, 0.3);
}

}  // namespace
}  // namespace weaveform
