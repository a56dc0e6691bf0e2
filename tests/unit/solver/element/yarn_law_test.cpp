// The yarn's law as the inner loop carries it (truss, seatbelt, compression-only partner, slack) against closed forms.
#include "solver/element/yarn_law.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "tests/support/chosen.hpp"
#include "tests/support/yarn_chain.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform {
namespace {

constexpr double length = 5.0, section = 1.25;  // mm, mm^2
constexpr double infinity = std::numeric_limits<double>::infinity();

// C(|e|) = 50 + 4000 |e| - 2000 e^2 up to 0.1, 700 from there on; S its integral.
Card curved_card() {
  Card card = test::small_card();
  for (YarnCard& yarn : card.yarn)
    yarn.compression = TangentLaw({{0.0, 0.1, {50.0, 4000.0, -2000.0}}, {0.1, infinity, {700.0}}});
  return card;
}
double curved_stress(double size) {
  const auto first = [](double g) { return 50.0 * g + 2000.0 * g * g - 2000.0 / 3.0 * g * g * g; };
  return size < 0.1 ? first(size) : first(0.1) + 700.0 * (size - 0.1);
}

// N = s A0 L0/L of an incompressible section, s A0 of a constant one.
double axial(const std::string& rule, double stress, double strain) {
  return stress * section * (rule == "constant" ? 1.0 : std::exp(-strain));
}

// The strain of a length rounded at 1e-16 is off by 1e-16, the stress by that times the tangent; then some roundings.
double rounding(double tangent, double force) {
  return 4e-16 * (3.0 * tangent * section + 10.0 * std::abs(force));
}

std::vector<double> strains() {
  std::vector<double> all;
  for (int n = -120; n <= 60; ++n) all.push_back(0.005 * n + 0.0007);
  for (const double near : {1e-3, 1e-6, 1e-12}) {
    for (const double joint : {0.0, -0.1, 0.1}) {
      all.push_back(joint - near);
      all.push_back(joint + near);
    }
  }
  return all;
}

class SectionRule : public testing::TestWithParam<const char*> {
protected:
  [[nodiscard]] static ModelSpec model(const std::string& yarn, const std::string& partner = "none",
                                       const std::string& law = "card") {
    ModelSpec model;
    model.yarn = test::chosen(yarn);
    model.partner = test::chosen(partner);
    model.yarn_law = test::chosen(law);
    model.section = test::chosen(GetParam());
    return model;
  }
  [[nodiscard]] static double force(const Card& card, const ModelSpec& model, double strain) {
    return test::element_force(card, model, yarn_laws(card, model), length, section, strain);
  }
};

INSTANTIATE_TEST_SUITE_P(All, SectionRule, testing::Values("incompressible", "constant"));

TEST_P(SectionRule, SeatbeltCarriesTheTrussTensionAndNothingElse) {
  const Card card = test::small_card();
  for (const double strain : strains()) {
    if (strain < 0.0)
      EXPECT_EQ(force(card, model("seatbelt"), strain), 0.0) << strain;
    else
      EXPECT_EQ(force(card, model("seatbelt"), strain), force(card, model("truss"), strain)) << strain;
  }
}

TEST_P(SectionRule, PartnerAloneCarriesExactlyItsLawInCompressionAndNothingInTension) {
  const Card curved = curved_card(), constant = test::small_card();
  for (const double scale : {1.0, 0.3})
    for (const double strain : strains()) {
      ModelSpec spec = model("seatbelt", "compression");
      spec.yarn_stiffness_scale = scale;
      const auto alone = [&](const Card& card) {
        return std::array{partner_law(card.yarn[0], spec), partner_law(card.yarn[1], spec)};
      };
      const double found = test::element_force(curved, spec, alone(curved), length, section, strain);
      const double simple = test::element_force(constant, spec, alone(constant), length, section, strain);
      if (strain > 0.0) {
        EXPECT_EQ(found, 0.0) << strain;
        EXPECT_EQ(simple, 0.0) << strain;
        continue;
      }
      const double expected = axial(GetParam(), -scale * curved_stress(-strain), strain);
      EXPECT_NEAR(found, expected, rounding(700.0, expected)) << strain;
      const double linear = axial(GetParam(), scale * 20.0 * strain, strain);
      EXPECT_NEAR(simple, linear, rounding(20.0, linear)) << strain;
    }
}

TEST_P(SectionRule, SeatbeltWithItsPartnerIsTheSumOfBothAndTheTruss) {
  const Card card = curved_card();
  for (const double strain : strains()) {
    const ModelSpec both = model("seatbelt", "compression");
    const auto partner = std::array{partner_law(card.yarn[0], both), partner_law(card.yarn[1], both)};
    const double together = force(card, both, strain);
    EXPECT_EQ(together, force(card, model("seatbelt"), strain) +
                            test::element_force(card, both, partner, length, section, strain))
        << strain;
    EXPECT_EQ(together, force(card, model("truss"), strain)) << strain;
  }
}

TEST_P(SectionRule, ACompressionModulusOfTheSceneTakesThePlaceOfTheCardsLaw) {
  const Card curved = curved_card();
  for (const double modulus : {0.0, 35.0}) {
    ModelSpec spec = model("truss");
    spec.compression_modulus = modulus;
    for (const double strain : strains()) {
      const double found = force(curved, spec, strain);
      if (strain > 0.0) {
        EXPECT_EQ(found, force(curved, model("truss"), strain)) << strain;
        continue;
      }
      const double expected = axial(GetParam(), modulus * strain, strain);
      EXPECT_NEAR(found, expected, rounding(modulus, expected)) << strain;
    }
  }
}

TEST_P(SectionRule, SlackYarnCarriesItsLinearModulusFromTheSlackStrainOn) {
  const Card twill = load_card("twintex-tw");
  for (const char* yarn : {"truss", "seatbelt"}) {
    ModelSpec automatic = model(yarn, "none", "slack"), given = automatic;
    given.slack = 0.03;
    const double crimp_slack = std::log(1.044);  // Table 1: warp 4.4 %
    for (const double strain : strains()) {
      if (strain < 0.0) continue;
      const auto expected = [&](double slack) {
        return axial(GetParam(), strain < slack ? 0.0 : 20080.0 * (strain - slack), strain);
      };
      const double found = force(twill, automatic, strain), found_given = force(twill, given, strain);
      EXPECT_NEAR(found, expected(crimp_slack), rounding(20080.0, found)) << yarn << ' ' << strain;
      EXPECT_NEAR(found_given, expected(0.03), rounding(20080.0, found_given)) << yarn << ' ' << strain;
      if (strain < crimp_slack) {
        EXPECT_EQ(found, 0.0) << yarn << ' ' << strain;
      }
    }
  }
  EXPECT_NEAR(slack_strain(twill.yarn[1], {}), std::log(1.008), 1e-16);
  EXPECT_NEAR(slack_strain(load_card("twintex-pw").yarn[0], {}), std::log(1.02), 1e-16);
}

TEST_P(SectionRule, YarnWithoutCrimpHasNoSlack) {
  Card card = test::small_card();
  for (const double strain : strains())
    EXPECT_EQ(force(card, model("truss", "none", "slack"), strain),
              force(card, model("truss", "none", "linear"), strain));
}

// The solver's potential against the work of the solver's force. Between the joints of the law both are smooth, and
// Simpson's rule on 400 intervals of h = 0.3 L0/400 errs by h^4/180 times the fourth derivative: below 1e-9 of the
// work.
TEST_P(SectionRule, StoredEnergyIsTheWorkOfTheForce) {
  const Card card = curved_card();
  for (const auto& [yarn, partner, law] : {std::tuple{"truss", "none", "card"},
                                           {"seatbelt", "none", "card"},
                                           {"seatbelt", "compression", "card"},
                                           {"seatbelt", "compression", "slack"},
                                           {"truss", "none", "linear"}}) {
    ModelSpec spec = model(yarn, partner, law);
    if (spec.yarn_law == YarnLaw::slack) spec.slack = 0.05;
    const Mesh mesh = test::chain_mesh(1, length, section, 1.0);
    InternalEnergy energy(mesh, card, yarn_laws(card, spec), spec);
    const auto stored = [&](double strain) { return energy({{0.0, 0.0, 0.0}, {length * std::exp(strain), 0.0, 0.0}}); };
    const double scale = std::max(stored(0.25), stored(-0.4));
    for (const auto& knots : {std::array{0.0, 0.05, 0.1, 0.25}, std::array{0.0, -0.05, -0.1, -0.4}}) {
      double work = 0.0;
      for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
        // a hair inside the piece, so that each end counts with its own piece
        const double inside = 1e-13 * (knots[k + 1] - knots[k]);
        const double from = length * std::exp(knots[k] + inside), to = length * std::exp(knots[k + 1] - inside);
        constexpr int intervals = 400;
        const double h = (to - from) / intervals;
        for (int i = 0; i <= intervals; ++i) {
          const double weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
          work += weight * h / 3.0 * force(card, spec, std::log((from + i * h) / length));
        }
        EXPECT_NEAR(stored(knots[k + 1]), work, 1e-9 * scale) << yarn << ' ' << law << ' ' << knots[k + 1];
      }
    }
  }
}

// dN/dL by differences of the solver's own force, at every strain up to the 0.5 that the step is bounded for.
TEST_P(SectionRule, StepCountsOnTheStiffestOfTensionAndCompression) {
  Card stiff = curved_card();
  for (YarnCard& yarn : stiff.yarn) yarn.compression = TangentLaw({{0.0, infinity, {1000.0, 20000.0}}});
  const Mesh mesh = test::chain_mesh(2, length, section, 1e-9);
  const ModelSpec spec = model("seatbelt", "compression");
  const auto laws = yarn_laws(stiff, spec);
  double greatest = 0.0;
  for (double strain = -0.5; strain < 0.5; strain += 0.001) {
    const double h = 1e-6;
    const double slope = (force(stiff, spec, strain + h) - force(stiff, spec, strain - h)) / (2.0 * h);  // N
    greatest = std::max(greatest, slope * std::exp(-strain) / section);                                  // dN/dL L0/A0
  }
  const double counted = CriticalStep(mesh, stiff, laws, spec, {0, 0, 0}).stiffest(every_strain)[0];
  EXPECT_GE(counted, greatest * (1.0 - 1e-6));
  EXPECT_LE(counted, 1.04 * greatest) << "steps of 0.01 strain: exp(2 * 0.01), and as much of the tangent";
}

// The compression of the built-in cards is too soft to matter: their step is that of the tension law.
TEST_P(SectionRule, StepOfTheBuiltinCardsIsThatOfTension) {
  for (const auto& name : builtin_card_names()) {
    const Card card = load_card(name);
    for (const char* law : {"card", "linear", "slack"}) {
      const Mesh mesh = test::chain_mesh(2, length, section, 1e-9);
      const ModelSpec spec = model("truss", "none", law);
      const auto stiffest = CriticalStep(mesh, card, yarn_laws(card, spec), spec, {0, 0, 0}).stiffest(every_strain);
      for (int f = 0; f < 2; ++f) {
        const double tension =
            law == std::string("card") ? card.yarn[f].tension.stiffest(0.0, 0.5) : card.yarn[f].linear_modulus;
        EXPECT_EQ(stiffest[f], tension) << name << ' ' << law;
      }
    }
  }
}

TEST(YarnLaw, FramesShowTheForceThatTheSolverTook) {
  const Card card = curved_card();
  const Mesh mesh = test::chain_mesh(1, length, section, 1.0);
  for (const char* partner : {"none", "compression"})
    for (const double strain : strains()) {
      ModelSpec spec;
      spec.yarn = YarnElement::seatbelt;
      spec.partner = test::chosen(partner);
      const double shown =
          compute_fields(mesh, card, spec, 0.0, {{0.0, 0.0, 0.0}, {length * std::exp(strain), 0.0, 0.0}}).yarn_force[0];
      const double taken = test::element_force(card, spec, yarn_laws(card, spec), length, section, strain);
      // the frame's law is a polynomial of the whole strain, whose constants round at the stress of the joints
      EXPECT_NEAR(shown, taken, rounding(2000.0, taken) + 1e-13) << strain;
      if (spec.partner == SeatbeltPartner::none && strain < 0.0) {
        EXPECT_EQ(shown, 0.0) << strain;
      }
    }
}

}  // namespace
}  // namespace weaveform
