// Seatbelt yarns in motion and in a fabric: what they may not do (make energy, change the shear force), and that with
// their partner they are the truss.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "solver/unit_cell.hpp"
#include "tests/support/chosen.hpp"
#include "tests/support/scene_run.hpp"
#include "tests/support/yarn_chain.hpp"

namespace weaveform {
namespace {

using test::Chain;
using test::Solved;

// Tension law, partner.
class FallingChain : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

INSTANTIATE_TEST_SUITE_P(All, FallingChain,
                         testing::Combine(testing::Values("card", "linear", "slack"),
                                          testing::Values("none", "compression")));

// Ten folded elements fall, snatch and swing for 100,000 steps (about 1.2 s), with the viscosity and step factor of the
// solver's defaults. All energies relative to the greatest one; measured over the six cases:
//   rise of kinetic + stored energy less the weight's work above any earlier value: at most 9e-6
//   the same with the viscosity's work added, against the start: -4e-4 to 2e-6
// The rise is that of the kinetic energy from the mean of two half-step velocities, of second order in the step (1e-8
// to 1e-5 here, by whether the shortest waves move). A slack yarn that made energy would show in thousands of snatches.
TEST_P(FallingChain, GoesSlackAndTautAgainWithoutMakingEnergy) {
  const Card card = load_card("twintex-pw");
  ModelSpec model;
  model.yarn = YarnElement::seatbelt;
  model.yarn_law = test::chosen(std::get<0>(GetParam()));
  model.partner = test::chosen(std::get<1>(GetParam()));
  model.yarn_stiffness_scale = 0.01;  // a ten times longer step: more of the fall in as many steps
  const AnalysisSpec analysis;
  constexpr double length = 5.0;  // mm
  const double mass = card.yarn[0].linear_density * length;
  Chain chain(test::chain_mesh(10, length, card.yarn[0].section, mass), card, model, analysis.yarn_viscosity,
              analysis.step_factor, {0.0, 0.0, -9810.0}, [](int n) {
                return Vec3{3.0 * n, (n % 2) * 4.0, 0.0};
              });
  double scale = 0.0, least = 0.0, rise = 0.0, greatest_made = 0.0, least_made = 0.0;
  while (chain.steps() < 100000) {
    const auto balance = chain.advance_and_balance();
    scale = std::max({scale, balance.kinetic, balance.internal, balance.weight});
    const double mechanical = balance.made() - balance.damping;
    rise = std::max(rise, mechanical - least);
    least = std::min(least, mechanical);
    greatest_made = std::max(greatest_made, balance.made());
    least_made = std::min(least_made, balance.made());
    for (int n = 0; n < 6; ++n) chain.advance();
  }
  EXPECT_GT(chain.switches(), 50) << "went from slack to taut";
  EXPECT_GT(scale, 0.9 * 11 * mass * 9810.0 * 15.0) << "mJ; the middle fell by some 15 mm at least";
  EXPECT_LT(rise, 3e-5 * scale);
  EXPECT_LT(greatest_made, 1e-5 * scale);
  EXPECT_GT(least_made, -1e-3 * scale);
  RecordProperty("rise", std::to_string(rise / scale));
  RecordProperty("made", std::to_string(greatest_made / scale));
  RecordProperty("lost", std::to_string(least_made / scale));
  RecordProperty("snatches", std::to_string(chain.switches()));
}

// A mass that falls 30 mm on its seatbelt, without viscosity: free flight between bounces on a spring. Per period
//   T = 2 v/g + (pi + 2 atan(g/(w v)))/w,   v^2 = 2 g h,  w^2 = E A/(m L0)
// so that a yarn that pushed or held the mass on its way up would show. A hundredth of the stable step is 2e-5 of the
// period and keeps it to 1e-4 for the three bounces (measured; a step ten times as long makes 1 % of energy in two
// seconds). The yarn's stiffness changes by 0.5 % at 0.2 % strain: 1e-5 of the period, of which a bounce takes 1/350.
TEST(BouncingMass, FliesFreelyBetweenBouncesOfTheClosedFormPeriod) {
  const Card card = load_card("twintex-pw");
  ModelSpec model;
  model.yarn = YarnElement::seatbelt;
  model.yarn_law = YarnLaw::linear;
  constexpr double length = 50.0, fall = 30.0, mass = 1e-5, gravity = 9810.0;  // mm, mm, tonne, mm/s^2
  Chain chain(test::chain_mesh(1, length, card.yarn[0].section, mass), card, model, 0.0, 0.01, {0.0, 0.0, -gravity},
              [](int n) {
                return Vec3{0.0, 0.0, n * (fall - length)};
              });
  std::vector<double> bounce;
  while (bounce.size() < 4) {
    const long before = chain.switches();
    chain.advance();
    if (chain.switches() > before) bounce.push_back(chain.time());
  }
  const double frequency = std::sqrt(card.yarn[0].linear_modulus * card.yarn[0].section / (mass * length));
  const double speed = std::sqrt(2.0 * gravity * fall);
  const double period =
      2.0 * speed / gravity + (std::numbers::pi + 2.0 * std::atan(gravity / (frequency * speed))) / frequency;
  EXPECT_NEAR(bounce.front(), speed / gravity, 1e-4 * period);
  for (std::size_t n = 1; n < bounce.size(); ++n)
    EXPECT_NEAR(bounce[n] - bounce[n - 1], period, 2e-4 * period) << "bounce " << n;
}

// Crossovers are pinned and the trellis stretches no yarn, so that the choice of yarn cannot show.
TEST(UnitCellYarns, PureShearIsTheSameForEveryYarn) {
  for (const auto& name : builtin_card_names()) {
    const Card card = load_card(name);
    const std::array sides = {card.yarn[0].interval, card.yarn[1].interval};
    for (const char* formulation : {"energy", "contravariant", "incremental"})
      for (const double angle : {60.0, -60.0}) {
        const UnitCellMotion motion{angle * std::numbers::pi / 180.0, 60, 0.3};
        ModelSpec model;
        model.formulation = test::chosen(formulation);
        const auto truss = shear_unit_cell(card, model, sides, motion);
        for (const char* law : {"card", "linear", "slack"})
          for (const char* partner : {"none", "compression"}) {
            model.yarn = YarnElement::seatbelt;
            model.yarn_law = test::chosen(law);
            model.partner = test::chosen(partner);
            const auto seatbelt = shear_unit_cell(card, model, sides, motion);
            for (std::size_t n = 0; n < truss.size(); ++n)
              EXPECT_NEAR(seatbelt[n].force, truss[n].force, 1e-9 * std::abs(truss[n].force))
                  << name << ' ' << formulation << ' ' << law << ' ' << partner << " at " << truss[n].angle;
          }
      }
  }
}

// A short bias extension of the plain weave, one cell in four.
Solved extended(const std::vector<std::string>& more) {
  std::vector<std::string> overrides = {"blank.coarsening=4", "grip.top.travel=10", "output.history=20"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return Solved(test::example("bias_extension_pw", overrides));
}

TEST(SeatbeltFabric, WithItsPartnerIsTheTrussBitForBit) {
  const Solved truss = extended({}), seatbelt = extended({"model.yarn=seatbelt", "model.partner=compression"});
  EXPECT_EQ(seatbelt.result.position, truss.result.position);
  EXPECT_EQ(seatbelt.result.history.row, truss.result.history.row);
}

// The yarns of a bias extension are in tension or nearly unstressed, so that load and angle hardly know of compression.
TEST(SeatbeltFabric, WithoutPartnerKeepsItsEnergyBalance) {
  const Solved truss = extended({});
  for (const char* law : {"card", "linear", "slack"}) {
    const Solved seatbelt = extended({"model.yarn=seatbelt", std::string("model.yarn_law=") + law});
    EXPECT_LT(seatbelt.result.statistics.energy_error, 5e-3) << law;  // the card's: 3e-3, its yarns snap taut
    const Solved stiffest =
        extended({"model.yarn=seatbelt", std::string("model.yarn_law=") + law, "analysis.step_bound=stiffest"});
    EXPECT_LT(stiffest.result.statistics.energy_error, 1e-3) << law;
    EXPECT_EQ(seatbelt.result.statistics.folded_cells, 0) << law;
    EXPECT_GT(seatbelt.last("top.force_N"), 0.0) << law;
    EXPECT_NEAR(seatbelt.last("top.force_N"), seatbelt.last("bottom.force_N"), 0.05 * seatbelt.last("top.force_N"))
        << law;
    if (law != std::string("card")) continue;
    EXPECT_NEAR(seatbelt.last("top.force_N"), truss.last("top.force_N"), 0.01 * truss.last("top.force_N"));
    EXPECT_NEAR(seatbelt.last("center.shear_angle_deg"), truss.last("center.shear_angle_deg"), 0.1);
  }
}

}  // namespace
}  // namespace weaveform
