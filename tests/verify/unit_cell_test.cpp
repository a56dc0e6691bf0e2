// The unit cell (the paper's Fig. 6): what each shear-cell variant returns of the shear force that was put in.
#include "solver/unit_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>

#include "core/vector/angle.hpp"
#include "post/unit_cell/closed_form.hpp"
#include "post/unit_cell/report.hpp"
#include "post/unit_cell/study.hpp"

namespace weaveform {
namespace {

// Card, shape (0 square, 1 rectangular), thickness.
using UnitCellCase = std::tuple<const char*, int, Thickness>;

class UnitCell : public testing::TestWithParam<UnitCellCase> {
protected:
  [[nodiscard]] static Card card() { return load_card(std::get<0>(GetParam())); }
  [[nodiscard]] static std::array<double, 2> sides() { return cell_shapes(card())[std::get<1>(GetParam())].sides; }
  [[nodiscard]] static Thickness thickness() { return std::get<2>(GetParam()); }
  [[nodiscard]] static std::vector<UnitCellPoint> run(Formulation formulation, const UnitCellMotion& motion) {
    ModelSpec model;
    model.formulation = formulation;
    model.thickness = thickness();
    return shear_unit_cell(card(), model, sides(), motion);
  }
};

INSTANTIATE_TEST_SUITE_P(All, UnitCell,
                         testing::Combine(testing::Values("twintex-pw", "twintex-tw"), testing::Values(0, 1),
                                          testing::Values(Thickness::constant_volume, Thickness::constant)));

// 1e-9: the angle of a nodal position rounded at 1e-16 of its size is exact to 1e-16 / 0.5 deg; 1e-13 of the strain.
TEST_P(UnitCell, WholeStressFormulationsReturnTheInputAtEveryAngle) {
  const Card fabric = card();
  for (const Formulation formulation : {Formulation::energy, Formulation::contravariant})
    for (const double to : {70.0 * degree, -70.0 * degree})
      for (const auto& point : run(formulation, {to, 140, 0.0})) {
        // Eq. 6 as printed, not the closed form the code uses
        const double log_strain = -std::log(std::tan(std::numbers::pi / 4.0 - point.angle / 2.0));
        double expected = fabric.thickness * shear_stress(fabric.shear, log_strain);
        if (thickness() == Thickness::constant) expected *= std::cos(point.angle);
        EXPECT_NEAR(point.force, expected, 1e-9 * std::abs(expected))
            << name_of(formulation) << " at " << point.angle / degree << " deg";
      }
}

// 1280 increments to 60 deg of 0.05 deg each: their error, of second order, is below (1e-3)^2 times a factor of
// order 1.
TEST_P(UnitCell, IncrementsTendToTheClosedForm) {
  for (const Formulation formulation : {Formulation::incremental, Formulation::side_frame})
    for (const auto& point : run(formulation, {60.0 * degree, 1280, 0.0})) {
      if (point.angle < 1.0 * degree) continue;
      const double ratio = point.force / analytical_shear_force(card(), point.angle);
      EXPECT_NEAR(ratio, closed_form_ratio(card().shear, formulation, thickness(), point.angle), 1e-5)
          << name_of(formulation) << " at " << point.angle / degree << " deg";
    }
}

TEST_P(UnitCell, NegativeAnglesMirrorPositiveOnes) {
  for (const Formulation formulation :
       {Formulation::energy, Formulation::contravariant, Formulation::incremental, Formulation::side_frame}) {
    const auto positive = run(formulation, {70.0 * degree, 70, 0.0});
    const auto negative = run(formulation, {-70.0 * degree, 70, 0.0});
    // scale: the analytical force, for the returned one passes through zero in the side frame
    for (std::size_t n = 0; n < positive.size(); ++n)
      EXPECT_NEAR(positive[n].force, -negative[n].force, 1e-11 * analytical_shear_force(card(), positive[n].angle))
          << name_of(formulation) << " at " << positive[n].angle / degree << " deg";
  }
}

// Objectivity: the force does not know of a rotation superposed on the shear. Exactly so without increments; with them
// to second order.
TEST_P(UnitCell, ForceDoesNotKnowOfARigidRotation) {
  const double to = 45.0 * degree, turn = 90.0 * degree;
  const auto difference = [&](Formulation formulation, int increments) {
    const double still = run(formulation, {to, increments, 0.0}).back().force;
    return std::abs(run(formulation, {to, increments, turn}).back().force / still - 1.0);
  };
  for (const Formulation formulation : {Formulation::energy, Formulation::contravariant})
    EXPECT_LT(difference(formulation, 1), 1e-12);
  for (const Formulation formulation : {Formulation::incremental, Formulation::side_frame}) {
    const double coarse = difference(formulation, 100), fine = difference(formulation, 200);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.05) << name_of(formulation);
    EXPECT_LT(difference(formulation, 3200), 1e-6) << name_of(formulation);
  }
}

// Numbers of the project's design, worked out on paper before there was code; given to three decimals.
TEST(UnitCellClosedForm, GivesTheRatiosWorkedOutForThePlainWeave) {
  const ShearCard shear = load_card("twintex-pw").shear;
  const std::map<double, double> constant_volume = {{30.0, 1.171}, {45.0, 1.244}, {60.0, 1.385}};
  const std::map<double, double> constant = {{30.0, 1.014}, {45.0, 0.880}, {60.0, 0.693}};
  for (const auto& [angle, ratio] : constant_volume)
    EXPECT_NEAR(closed_form_ratio(shear, Formulation::incremental, Thickness::constant_volume, angle * degree), ratio,
                1e-3)
        << angle;
  for (const auto& [angle, ratio] : constant)
    EXPECT_NEAR(closed_form_ratio(shear, Formulation::incremental, Thickness::constant, angle * degree), ratio, 1e-3)
        << angle;
}

// The defining integrals over the tangent (docs/unit_cell.md, before integration by parts), by Simpson's rule.
class ClosedForm : public testing::TestWithParam<const char*> {
protected:
  template <class Function>
  static double simpson(double end, const Function& function) {
    constexpr int intervals = 2000;
    const double h = end / intervals;
    double sum = function(0.0) + function(end);
    for (int n = 1; n < intervals; ++n) sum += (n % 2 == 1 ? 4.0 : 2.0) * function(n * h);
    return sum * h / 3.0;
  }
};
INSTANTIATE_TEST_SUITE_P(Fabrics, ClosedForm, testing::Values("twintex-pw", "twintex-tw"));

TEST_P(ClosedForm, IncrementalIsTheIntegralOverItsHistory) {
  const ShearCard shear = load_card(GetParam()).shear;
  for (double angle = 5.0 * degree; angle < 71.0 * degree; angle += 5.0 * degree) {
    const double end = std::atanh(std::sin(angle)), cosine = std::cos(angle);
    // sin gamma = tanh gamma_L
    const double normal = simpson(end, [&](double g) { return std::tanh(g) * shear_tangent(shear, g); });
    const double stress = shear_stress(shear, end);
    const double ratio = (stress - std::sin(angle) * normal) / (stress * cosine * cosine);
    EXPECT_NEAR(closed_form_ratio(shear, Formulation::incremental, Thickness::constant_volume, angle), ratio, 1e-9)
        << angle / degree;
    EXPECT_NEAR(closed_form_ratio(shear, Formulation::incremental, Thickness::constant, -angle), ratio * cosine, 1e-9)
        << angle / degree;
  }
}

TEST_P(ClosedForm, SideFrameIsTheIntegralOverItsHistory) {
  const ShearCard shear = load_card(GetParam()).shear;
  for (double angle = 5.0 * degree; angle < 71.0 * degree; angle += 5.0 * degree) {
    const double end = std::atanh(std::sin(angle)), cosine = std::cos(angle);
    const double along = simpson(angle, [&](double g) { return shear_tangent(shear, g); });
    const double normal = simpson(angle, [&](double g) { return std::sin(g) * shear_tangent(shear, g); });
    const double ratio = (along - std::tan(angle) * normal) / (shear_stress(shear, end) * cosine);
    EXPECT_NEAR(closed_form_ratio(shear, Formulation::side_frame, Thickness::constant_volume, angle), ratio, 1e-9)
        << angle / degree;
    EXPECT_NEAR(closed_form_ratio(shear, Formulation::side_frame, Thickness::constant, -angle), ratio * cosine, 1e-9)
        << angle / degree;
  }
}

// A card with a friction-like start that rises over a thousandth of the range still has its closed forms, and the cell
// still tends to them.
TEST(UnitCellClosedForm, HoldsForAFrictionLikeStart) {
  Card card = load_card("twintex-pw");
  card.shear.start = {0.05, 1e-3};
  for (const Formulation formulation : {Formulation::incremental, Formulation::side_frame}) {
    ModelSpec model;
    model.formulation = formulation;
    const double angle = 50.0 * degree;
    const double force = shear_unit_cell(card, model, {5.0, 5.0}, {angle, 40000, 0.0}).back().force;
    // increments of 2e-5 against a rise of 1e-3: the midpoint rule's error is about (2e-5/1e-3)^2/24 of the plateau
    EXPECT_NEAR(force / analytical_shear_force(card, angle),
                closed_form_ratio(card.shear, formulation, Thickness::constant_volume, angle), 1e-5)
        << name_of(formulation);
  }
}

TEST(UnitCellClosedForm, IsOneAtTheFlatCell) {
  const ShearCard shear = load_card("twintex-pw").shear;
  for (const Formulation formulation :
       {Formulation::energy, Formulation::contravariant, Formulation::incremental, Formulation::side_frame})
    for (const Thickness thickness : {Thickness::constant_volume, Thickness::constant})
      // errors begin with gamma^2: 1e-8 at 1e-4
      EXPECT_NEAR(closed_form_ratio(shear, formulation, thickness, 1e-4), 1.0, 1e-7)
          << name_of(formulation) << name_of(thickness);
}

class Study : public testing::Test {
protected:
  static const UnitCellStudy& study() {
    static const UnitCellStudy done = [] {
      UnitCellOptions options;
      options.to = 70.0 * degree;
      options.increments = 700;
      return study_unit_cell(load_card("twintex-pw"), options);
    }();
    return done;
  }
  static const UnitCellCurve& curve(Formulation formulation, Thickness thickness) {
    const auto found = std::find_if(study().curve.begin(), study().curve.end(), [&](const UnitCellCurve& c) {
      return c.variant.formulation == formulation && c.variant.thickness == thickness &&
             c.variant.shape.name == "square";
    });
    return *found;
  }
};

TEST_F(Study, HoldsEveryVariantOfBothShapes) {
  EXPECT_EQ(study().curve.size(), 2U * 4U * 2U);
}

TEST_F(Study, ConvergenceIsOfSecondOrderToTheClosedForm) {
  ASSERT_EQ(study().convergence.size(), 4U);
  for (const auto& convergence : study().convergence) {
    for (std::size_t n = 3; n < convergence.row.size(); ++n)
      EXPECT_NEAR(convergence.row[n].order, 2.0, 0.02)
          << convergence.variant.name() << " " << convergence.row[n].increments;
    EXPECT_NEAR(convergence.extrapolated, convergence.closed_form, 1e-8) << convergence.variant.name();
  }
}

// The angle at which |closed form - 1| first passes 5 %, by bisection between 1 deg and an angle known to be past it.
TEST_F(Study, AngleHeldIsWhereTheClosedFormLeavesTheTolerance) {
  const auto& shear = study().card.shear;
  for (const auto& c : study().curve) {
    double first = 1.0 * degree;
    const auto outside = [&](double angle) {
      return std::abs(closed_form_ratio(shear, c.variant.formulation, c.variant.thickness, angle) - 1.0) >
             unit_cell_tolerance;
    };
    while (first < study().options.to && !outside(first)) first += 0.001 * degree;
    EXPECT_NEAR(c.holds_to, std::min(first, study().options.to), 0.01 * degree) << c.variant.name();
  }
}

TEST_F(Study, SideFrameTurnsNegativeBeforeSixtyDegrees) {
  for (const Thickness thickness : {Thickness::constant_volume, Thickness::constant}) {
    EXPECT_GT(error_at(study(), curve(Formulation::side_frame, thickness), 45.0 * degree), -1.0);
    EXPECT_LT(error_at(study(), curve(Formulation::side_frame, thickness), 60.0 * degree), -1.0);
  }
}

TEST_F(Study, TableHasARowForEachAngleAndAColumnPairForEachVariant) {
  const std::string csv = unit_cell_csv(study());
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 141);
  const std::string head = csv.substr(0, csv.find('\n'));
  EXPECT_EQ(std::count(head.begin(), head.end(), ','), 1 + 2 * 16);
  EXPECT_NE(head.find("rectangular.membrane.side-frame.constant.relative_error"), std::string::npos);
}

// Twins (energy and contravariant) are drawn once: 3 kinds x 2 thickness rules, and the analytical points.
TEST_F(Study, ChartsDrawEachCurveOnce) {
  const Chart chart = unit_cell_chart(study());
  EXPECT_EQ(chart.series.size(), 3U * 2U + 1U);
  EXPECT_EQ(chart.series.front().label, "energy and contravariant, constant volume");
  EXPECT_EQ(unit_cell_error_chart(study()).series.size(), 3U * 2U);
}

}  // namespace
}  // namespace weaveform
