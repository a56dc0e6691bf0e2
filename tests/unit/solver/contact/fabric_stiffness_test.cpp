// Whose stiffness contact with tools has.
#include "solver/contact/fabric_stiffness.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/contact/contact.hpp"

namespace weaveform {
namespace {

// N/mm^3
double stiffness(const AnalysisSpec& analysis, const Card& card, double step) {
  const double frequency = tool_contact_frequency(analysis, card, step);
  return frequency * frequency * card.area_density() * analysis.mass_scale;
}

TEST(FabricStiffness, IsThatOfTheStepOnCoarseMeshesAndTheUsualOneOnFineOnes) {
  const Card card = load_card("twintex-pw");
  const AnalysisSpec analysis;
  const double coarse = 2e-5, fine = 1e-6;  // s
  EXPECT_EQ(tool_contact_frequency(analysis, card, coarse), contact_frequency(analysis, coarse));
  EXPECT_LT(stiffness(analysis, card, coarse), usual_thickness_stiffness);
  EXPECT_NEAR(stiffness(analysis, card, fine), usual_thickness_stiffness, 1e-12);
}

TEST(FabricStiffness, IsTheCardsWhereItSaysAndTheScenesFactorBoundsIt) {
  Card card = load_card("twintex-pw");
  card.through_thickness_stiffness = 3.0;
  AnalysisSpec analysis;
  for (const double step : {2e-5, 1e-6}) EXPECT_NEAR(stiffness(analysis, card, step), 3.0, 1e-12);
  analysis.mass_scale = 4.0;  // mass is not stiffness
  EXPECT_NEAR(stiffness(analysis, card, 1e-6), 3.0, 1e-12);
  analysis.mass_scale = 1.0;
  analysis.contact_stiffness = 0.5;
  EXPECT_EQ(tool_contact_frequency(analysis, card, 2e-5), contact_frequency(analysis, 2e-5));
  EXPECT_NEAR(stiffness(analysis, card, 1e-6), 3.0, 1e-12);
  card.through_thickness_stiffness.reset();
  EXPECT_EQ(tool_contact_frequency(analysis, card, 1e-6), contact_frequency(analysis, 1e-6));
}

}  // namespace
}  // namespace weaveform
