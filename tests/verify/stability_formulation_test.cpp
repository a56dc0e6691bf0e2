// How far each formulation of the cell holds (docs/stability.md): the angle at which its force leaves the card's by 5
// %, from closed forms of the card, and the increment at which increments alone cost 1 %.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/vector/angle.hpp"
#include "fabric/trellis/shear_frame.hpp"
#include "post/unit_cell/closed_form.hpp"
#include "post/unit_cell/study.hpp"
#include "solver/unit_cell.hpp"
#include "tests/support/trust.hpp"

namespace weaveform {
namespace {

using test::Solved;

const std::vector<std::pair<Formulation, Thickness>> variants = {
    {Formulation::energy, Thickness::constant_volume},
    {Formulation::energy, Thickness::constant},
    {Formulation::contravariant, Thickness::constant_volume},
    {Formulation::incremental, Thickness::constant_volume},
    {Formulation::incremental, Thickness::constant},
    {Formulation::side_frame, Thickness::constant_volume},
    {Formulation::side_frame, Thickness::constant}};

// One cell, sheared by the solver's inner loop in fine increments (0.05 deg), returned over analytical force.
double returned_ratio(const Card& card, const ModelSpec& model, double angle, int increments) {
  const auto points = shear_unit_cell(card, model, {5.0, 5.0}, {.angle = angle, .increments = increments});
  return points.back().force / analytical_shear_force(card, angle);
}

ModelSpec model_of(const std::pair<Formulation, Thickness>& variant) {
  ModelSpec model;
  model.formulation = variant.first;
  model.thickness = variant.second;
  return model;
}

// The cards of the paper, and fabrics that stiffen early, late and not at all.
std::vector<Card> cards() {
  Card constant = load_card("twintex-pw"), stiffening = constant, falling = constant;
  constant.shear.tangent = TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {0.3}}});
  stiffening.shear.tangent = TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {0.05, 0.0, 4.0}}});
  falling.shear.tangent = TangentLaw({{0.0, std::numeric_limits<double>::infinity(), {0.5, -1.2, 0.9}}});
  return {load_card("twintex-pw"), load_card("twintex-tw"), constant, stiffening, falling};
}

TEST(StabilityFormulation, TheBorderOfEveryCardLiesWhereTheCellOfTheInnerLoopLeavesByFivePercent) {
  for (const Card& card : cards())
    for (const auto& variant : variants) {
      const double border =
          formulation_holds_to(card.shear, variant.first, variant.second, unit_cell_tolerance) / degree;
      SCOPED_TRACE(testing::Message() << name_of(variant.first) << ' ' << name_of(variant.second) << " border "
                                      << border);
      const auto off = [&](double angle) {
        return std::abs(returned_ratio(card, model_of(variant), angle * degree, static_cast<int>(20.0 * angle)) - 1.0);
      };
      const double below = std::min(0.9 * border, 70.0);
      EXPECT_LT(off(below), unit_cell_tolerance);
      if (border < 60.0) {
        EXPECT_GT(off(1.05 * border), unit_cell_tolerance);
      }
    }
}

TEST(StabilityFormulation, EnergyAndContravariantHaveNoBorderAndConstantThicknessHasThatOfItsCosine) {
  for (const Card& card : cards())
    for (const Formulation formulation : {Formulation::energy, Formulation::contravariant}) {
      EXPECT_EQ(formulation_holds_to(card.shear, formulation, Thickness::constant_volume, 0.05), 89.0 * degree);
      EXPECT_NEAR(formulation_holds_to(card.shear, formulation, Thickness::constant, 0.05), std::acos(0.95), 1e-8);
    }
}

// Second order in the increment: at half of the border a quarter of the error. A run makes increments far smaller: a
// cell that turns by 5 deg in a step has nodes that move a tenth of its side, at a tenth of the yarns' speed of sound.
TEST(StabilityFormulation, IncrementsAloneCostAPercentFromAboutSixDegreesOn) {
  const Card card = load_card("twintex-pw");
  for (const auto& variant : variants) {
    const ModelSpec model = model_of(variant);
    const auto error = [&](int increments) {
      const double exact = closed_form_ratio(card.shear, model.formulation, model.thickness, 60.0 * degree);
      return std::abs(returned_ratio(card, model, 60.0 * degree, increments) / exact - 1.0);
    };
    SCOPED_TRACE(testing::Message() << name_of(variant.first) << ' ' << name_of(variant.second));
    if (model.formulation == Formulation::energy || model.formulation == Formulation::contravariant) {
      EXPECT_LT(error(1), 1e-9) << "no increments";
      continue;
    }
    EXPECT_LT(error(30), 0.01);    // 2 deg
    EXPECT_GT(error(3), 0.01);     // 20 deg
    EXPECT_LT(error(60), 0.0025);  // 1 deg
  }
}

// A rigid frame shears the fabric by the angle that its travel dictates, whatever the cell returns.
TEST(StabilityFormulation, ARunBeyondTheCardsBorderIsWarnedAndOneBelowIsNot) {
  const Card card = load_card("twintex-pw");
  for (const auto& variant : variants) {
    const double border = formulation_holds_to(card.shear, variant.first, variant.second, unit_cell_tolerance);
    const auto warned = [&](double angle) {
      Scene scene = test::example("shear_frame_pw", {"frame.rigid=true", "blank.coarsening=8", "analysis.duration=0.05",
                                                     "output.frames=0", "output.history=20"});
      scene.model.formulation = variant.first;
      scene.model.thickness = variant.second;
      scene.frame->travel = frame_displacement({scene.frame->length, scene.blank.size[0]}, angle);
      return test::says(test::warnings_of(Solved(scene)), name_of(variant.first));
    };
    SCOPED_TRACE(testing::Message() << name_of(variant.first) << ' ' << name_of(variant.second) << ' '
                                    << border / degree);
    EXPECT_FALSE(warned(std::min(0.9 * border, 55.0 * degree)));
    if (border < 50.0 * degree) {
      EXPECT_TRUE(warned(1.1 * border));
    }
  }
}

}  // namespace
}  // namespace weaveform
