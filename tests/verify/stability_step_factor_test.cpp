// The border of the step (docs/stability.md, bench/stability/step_factor*.toml), on both sides of it. Central
// difference with velocities at half steps, of a mode of frequency w in yarns whose viscosity is x h0 times their
// stiffest tangent (h0 = 2/w0 the step of the bound; its force lags half a step), is stable for  h^2 w^2/4 + h x
// ws^2/w0 <= 1 , ws the frequency that the mode has at the stiffest tangent. With r = (w/w0)^2, s = (ws/w0)^2
//   h/h0 <= (sqrt(x^2 s^2 + r) - x s)/r ,
// while the analysis takes the factor times h0 (sqrt(1 + x^2) - x), so that its border is
//   factor = (sqrt(x^2 s^2 + r) - x s)/r / (sqrt(1 + x^2) - x) .
// A strip pulled along its warp has r and s in closed form: all its warp yarns stretch alike.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "solver/element/yarn_law.hpp"
#include "solver/ply/critical_step.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/trust.hpp"

namespace weaveform {
namespace {

using test::Solved;

constexpr double pull_length = 196.8;  // mm; ten elements of the plain weave at coarsening 4

// Stretched to a true strain at the end, without the step's own check.
Scene pulled(double strain, double factor, const std::string& material = "twintex-pw") {
  Scene scene = test::strip_scene(material, {pull_length, 59.04}, 4.0, pull_length * std::expm1(strain));
  scene.analysis.duration = 0.05;
  scene.analysis.step_check = false;
  scene.analysis.step_factor = factor;
  scene.analysis.step_bound = StepBound::stiffest;  // whose borders these are
  return scene;
}

struct Ratios {
  double reached = 0.0, stiffest = 0.0;  // 1; r and s
};

double border(const Ratios& ratio, double viscosity) {
  const double xs = viscosity * ratio.stiffest;
  return (std::sqrt(xs * xs + ratio.reached) - xs) / ratio.reached /
         (std::sqrt(1.0 + viscosity * viscosity) - viscosity);
}

// Warp yarns are clamped chains of N elements: w^2 = 4 k/m cos^2(pi/2N), with an incompressible section
// k = dN/dL = (C - s) exp(-2e) A0/L0 at a true strain e. The bound knows its own w0^2.
Ratios frequency_ratios(const Scene& scene, double strain) {
  const Card card = load_card(scene.fabric.material);
  const Mesh mesh = build_mesh(scene, card);
  const auto laws = yarn_laws(card, scene.model);
  std::vector<char> held(mesh.node_count(), 0);
  for (const NodeSet& set : mesh.sets)
    for (const int n : set.node) held[n] = 1;
  const CriticalStep bound(mesh, card, laws, scene.model, held);
  const double reached = (laws[0].tangent(strain) - laws[0].stress(strain)) * std::exp(-2.0 * strain);  // MPa
  double unit = 0.0;  // 1/(s^2 MPa); of the stiffest chain
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const auto [a, b] = mesh.yarns.node[e];
    if (mesh.yarns.family[e] != Family::warp || held[a] != 0 || held[b] != 0) continue;
    const double rest = mesh.yarns.rest_length[e];
    unit = std::max(unit, 4.0 * mesh.yarns.section[e] / rest / mesh.nodes.mass[a] *
                              std::pow(std::cos(std::numbers::pi / 2.0 * rest / pull_length), 2));
  }
  const double step = bound(mesh.nodes.position, bound.stiffest(every_strain)).step;
  const double per_bound = unit * step * step / 4.0;
  return {reached * per_bound, bound.stiffest(every_strain)[0] * per_bound};
}

double held_load(const Solved& run) {
  const double strain = std::log(1.0 + run.scene.grip[1].travel / pull_length);
  double section = 0.0;  // mm2; of the warp across the strip
  for (int e = 0; e < run.mesh.yarn_count(); ++e)
    if (run.mesh.yarns.family[e] == Family::warp)
      section += run.mesh.yarns.section[e] * run.mesh.yarns.rest_length[e] / pull_length;
  return yarn_laws(run.card, run.scene.model)[0].stress(strain) * std::exp(-strain) * section;
}

void expect_border(const Scene& scene, double border, double expected_load_error = 0.01) {
  Scene below = scene, above = scene;
  below.analysis.step_factor = 0.9 * border;
  above.analysis.step_factor = 1.1 * border;
  const Solved run(below);
  EXPECT_LT(run.result.statistics.energy_error, 0.01);
  EXPECT_NEAR(run.last("right.force_N") / held_load(run), 1.0, expected_load_error);
  EXPECT_TRUE(test::warnings_of(run).empty());
  EXPECT_THROW(Solved{above}, PhysicsError) << "factor " << above.analysis.step_factor;
}

// The card's yarns decrimp: what sets the step is a stiffness that they reach only when straight.
TEST(StabilityStepFactor, CardYarnsHoldFarAboveTheBoundUntilTheyAreTaut) {
  int borders = 0;
  for (const char* material : {"twintex-pw", "twintex-tw"})
    for (const double taut : {0.5, 0.7, 0.9}) {
      const double strain = taut * load_card(material).yarn[0].tension.pieces().back().from;
      for (const double viscosity : {0.06, 0.2}) {
        Scene scene = pulled(strain, 1.0, material);
        scene.analysis.yarn_viscosity = viscosity;
        SCOPED_TRACE(testing::Message() << material << " strain " << strain << " viscosity " << viscosity);
        const double factor = border(frequency_ratios(scene, strain), viscosity);
        EXPECT_GT(factor, 1.05);
        if (1.1 * factor > 4.0) continue;  // scene keys end there
        expect_border(scene, factor);
        ++borders;
      }
    }
  EXPECT_GE(borders, 8);
}

// Without decrimping the stiffness is there at once; slack yarns have it from one step to the next.
TEST(StabilityStepFactor, LinearAndSlackYarnsHoldToTheBoundAndNoFurther) {
  for (const double slack : {0.0, 0.01, 0.02, 0.05}) {
    Scene scene = pulled(slack + 0.001, 1.0);
    scene.model.yarn_law = slack == 0.0 ? YarnLaw::linear : YarnLaw::slack;
    if (slack > 0.0) scene.model.slack = slack;
    SCOPED_TRACE(testing::Message() << "slack " << slack);
    const Ratios ratio = frequency_ratios(scene, slack + 0.001);
    EXPECT_NEAR(ratio.reached, 1.0, 0.15) << "the bound counts with exp(-2e) = 1 and an endless chain";
    expect_border(scene, border(ratio, scene.analysis.yarn_viscosity), 0.05);
  }
}

TEST(StabilityStepFactor, EveryElementHoldsToTheBoundAndNoFurther) {
  for (const auto& [yarn, cell] :
       {std::pair{"beam", "membrane"}, std::pair{"seatbelt", "membrane"}, std::pair{"truss", "rotation-free"},
        std::pair{"truss", "shell"}, std::pair{"beam", "shell"}}) {
    Scene scene = pulled(0.001, 1.0);
    scene.model.yarn_law = YarnLaw::linear;
    scene.model.yarn = test::chosen(yarn);
    scene.model.cell = test::chosen(cell);
    scene.analysis.gravity = {0.0, 0.0,
                              -100.0};  // mm/s2; a hundredth of its weight, so that it leaves its plane at all
    SCOPED_TRACE(testing::Message() << yarn << " + " << cell);
    expect_border(scene, border(frequency_ratios(scene, 0.001), scene.analysis.yarn_viscosity));
  }
}

// The rotary inertia of shells is raised to what the bound's step needs, with a margin; 2.6 was found by bisection
// (bench/stability/step_factor_elements.toml). The yarns of this strip alone would hold to 4.5.
TEST(StabilityStepFactor, ShellsHaveABorderOfTheirOwnWhereYarnsHaveNone) {
  Scene scene = pulled(0.008, 2.9);
  scene.analysis.gravity = {0.0, 0.0, -100.0};
  scene.model.cell = CellElement::rotation_free;
  EXPECT_LT(Solved{scene}.result.statistics.energy_error, 0.01);
  scene.model.cell = CellElement::shell;
  EXPECT_THROW(Solved{scene}, PhysicsError);
  scene.analysis.step_factor = 2.3;
  EXPECT_LT(Solved{scene}.result.statistics.energy_error, 0.01);
}

// Just above the border viscosity takes what the steps make, and the load still looks right: the balance tells.
TEST(StabilityStepFactor, AStepThatMakesEnergyIsToldByTheBalanceEvenWhereTheRunGoesOn) {
  Scene scene =
      test::example("bias_extension_pw", {"blank.coarsening=4", "analysis.duration=0.3", "model.yarn_law=linear",
                                          "analysis.step_check=false", "analysis.energy_limit=1", "output.frames=0",
                                          "analysis.step_bound=stiffest"});
  const auto warned = [&](double factor) {
    scene.analysis.step_factor = factor;
    return test::says(test::warnings_of(Solved(scene)), "energy balance");
  };
  EXPECT_FALSE(warned(0.9));
  EXPECT_TRUE(warned(1.03));
}

}  // namespace
}  // namespace weaveform
