#include "solver/ply/torn_yarns.hpp"

#include <gtest/gtest.h>

#include "solver/element/yarn_law.hpp"
#include "solver/ply/reach.hpp"
#include "solver/ply/strain_error.hpp"
#include "tests/support/chosen.hpp"

namespace weaveform {
namespace {

TEST(YarnLimits, AreTheCardsOwnForTheCardsLaw) {
  const Card card = load_card("twintex-tw");
  for (const std::string section : {"constant", "incompressible"}) {
    ModelSpec model;
    model.section = test::chosen(section);
    const YarnLimits limits = yarn_limits(card, model);
    for (std::size_t f = 0; f < 2; ++f) {
      EXPECT_NEAR(limits.valid_to[f], card.yarn[f].valid_to, 1e-12);
      EXPECT_NEAR(limits.tearing[f], card.yarn[f].tearing_strain, 1e-12);
    }
  }
}

// A yarn is torn by its force, whatever strain the model's law has it at.
TEST(YarnLimits, OfAnotherLawBearTheSameForce) {
  const Card card = load_card("twintex-pw");
  for (const double scale : {0.2, 1.0, 3.0})
    for (const std::string law : {"card", "linear", "slack"}) {
      ModelSpec model;
      model.yarn_stiffness_scale = scale;
      model.yarn_law = test::chosen(law);
      const YarnLimits limits = yarn_limits(card, model);
      const auto laws = yarn_laws(card, model);
      for (std::size_t f = 0; f < 2; ++f) {
        const double torn = nominal_stress(card.yarn[f].tension, card.yarn[f].tearing_strain, false);
        EXPECT_NEAR(nominal_stress(laws[f], limits.tearing[f], false), torn, 1e-6 * torn) << scale << law;
        EXPECT_LT(limits.valid_to[f], limits.tearing[f]);
      }
    }
}

TEST(YarnLimits, NeverPassTheStrainAtWhichEveryRunEnds) {
  Card card = load_card("twintex-pw");
  ModelSpec model;
  model.yarn_stiffness_scale = 1e-3;
  for (auto& yarn : card.yarn) yarn.valid_to = yarn.tearing_strain = 0.5;
  const YarnLimits limits = yarn_limits(card, model);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_LE(limits.valid_to[f], torn_strain);
    EXPECT_LE(limits.tearing[f], torn_strain);
  }
}

}  // namespace
}  // namespace weaveform
