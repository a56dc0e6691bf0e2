#include "post/unit_cell/study.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/vector/angle.hpp"
#include "post/unit_cell/closed_form.hpp"
#include "solver/unit_cell.hpp"

namespace weaveform {

namespace {

ModelSpec model_of(const UnitCellVariant& variant) {
  ModelSpec model;
  model.cell = variant.cell;
  model.formulation = variant.formulation;
  model.thickness = variant.thickness;
  return model;
}

bool counts_in_increments(const UnitCellVariant& variant) {
  return variant.formulation == Formulation::incremental || variant.formulation == Formulation::side_frame;
}

std::vector<UnitCellVariant> all_variants(const Card& card, const UnitCellOptions& options) {
  std::vector<UnitCellVariant> variants;
  for (const auto& shape : cell_shapes(card))
    for (const auto& cell : options.cells)
      for (const auto& formulation : options.formulations)
        for (const auto& thickness : options.thicknesses) variants.push_back({shape, cell, formulation, thickness});
  return variants;
}

// Index of the study's angle 0.
std::size_t middle_of(const UnitCellStudy& study) {
  return study.angle.size() / 2;
}

// Shear angle up to which the error keeps within the tolerance on the side `sense` (+1 or -1).
double held_angle(const UnitCellStudy& study, const UnitCellCurve& curve, int sense) {
  const std::size_t middle = middle_of(study);
  for (std::size_t n = 1; n <= middle; ++n) {
    const std::size_t at = sense > 0 ? middle + n : middle - n, before = sense > 0 ? at - 1 : at + 1;
    const double error = std::abs(curve.error[at]), last = std::abs(curve.error[before]);
    if (error <= unit_cell_tolerance) continue;
    const double part = (unit_cell_tolerance - last) / (error - last);
    return std::abs(study.angle[before] + part * (study.angle[at] - study.angle[before]));
  }
  return study.options.to;
}

UnitCellCurve run_variant(const UnitCellStudy& study, const UnitCellVariant& variant) {
  UnitCellCurve curve{variant, {}, {}, 0.0, 0.0};
  const std::size_t middle = middle_of(study);
  curve.force.assign(study.angle.size(), 0.0);
  curve.error.assign(study.angle.size(), 0.0);
  for (const int sense : {-1, 1}) {
    const UnitCellMotion motion{sense * study.options.to, study.options.increments, 0.0};
    const auto points = shear_unit_cell(study.card, model_of(variant), variant.shape.sides, motion);
    for (std::size_t n = 1; n <= points.size(); ++n) {
      const std::size_t at = sense > 0 ? middle + n : middle - n;
      curve.force[at] = points[n - 1].force;
      const double ratio = curve.force[at] / study.analytical[at];
      const double limit = closed_form_ratio(study.card.shear, variant.formulation, variant.thickness, study.angle[at]);
      curve.error[at] = ratio - 1.0;
      curve.closed_form_distance = std::max(curve.closed_form_distance, std::abs(ratio - limit));
    }
  }
  curve.holds_to = std::min(held_angle(study, curve, -1), held_angle(study, curve, 1));
  return curve;
}

double ratio_at_end(const Card& card, const UnitCellVariant& variant, const UnitCellMotion& motion) {
  const auto points = shear_unit_cell(card, model_of(variant), variant.shape.sides, motion);
  return points.back().force / analytical_shear_force(card, motion.angle);
}

UnitCellConvergence converge(const Card& card, const UnitCellVariant& variant, double angle) {
  constexpr int coarsest = 10, halvings = 7;  // 10, 20, ... 1280 increments
  constexpr double rounding = 1e-11;          // below it a distance says nothing of the order
  UnitCellConvergence result{
      variant, angle, closed_form_ratio(card.shear, variant.formulation, variant.thickness, angle), 0.0, {}};
  for (int k = 0; k <= halvings; ++k) {
    ConvergenceRow row;
    row.increments = coarsest << k;
    row.ratio = ratio_at_end(card, variant, {angle, row.increments, 0.0});
    row.distance = std::abs(row.ratio - result.closed_form);
    const bool measurable = k > 0 && row.distance > rounding;
    row.order =
        measurable ? std::log2(result.row.back().distance / row.distance) : std::numeric_limits<double>::quiet_NaN();
    result.row.push_back(row);
  }
  const double fine = result.row.back().ratio, coarse = result.row[result.row.size() - 2].ratio;
  result.extrapolated = fine + (fine - coarse) / 3.0;
  return result;
}

RotationCost rotation_cost(const Card& card, const UnitCellVariant& variant, double angle) {
  RotationCost cost{variant, angle, {}};
  for (const int increments : {1, 3, 10, 30, 100, 300, 1000})
    cost.row.push_back({increments, ratio_at_end(card, variant, {angle, increments, 0.0}),
                        ratio_at_end(card, variant, {angle, increments, std::numbers::pi / 2.0})});
  return cost;
}

}  // namespace

std::string UnitCellVariant::name() const {
  return shape.name + "." + name_of(cell) + "." + name_of(formulation) + "." + name_of(thickness);
}

std::array<CellShape, 2> cell_shapes(const Card& card) {
  const double warp = card.yarn[0].interval, weft = card.yarn[1].interval;
  return {{{"square", {warp, warp}}, {"rectangular", {weft, warp == weft ? 2.0 * warp : warp}}}};
}

UnitCellStudy study_unit_cell(const Card& card, const UnitCellOptions& options) {
  UnitCellStudy study{card, options, {}, {}, {}, {}, {}};
  for (int n = -options.increments; n <= options.increments; ++n) {
    study.angle.push_back(static_cast<double>(n) / options.increments * options.to);
    study.analytical.push_back(analytical_shear_force(card, study.angle.back()));
  }
  const double convergence_angle = std::min(options.to, 60.0 * degree);
  const double rotation_angle = std::min(options.to, 45.0 * degree);
  for (const auto& variant : all_variants(card, options)) {
    study.curve.push_back(run_variant(study, variant));
    // The shape of the cell changes nothing, so one shape tells all.
    if (!counts_in_increments(variant) || variant.shape.name != "square") continue;
    study.convergence.push_back(converge(card, variant, convergence_angle));
    study.rotation.push_back(rotation_cost(card, variant, rotation_angle));
  }
  return study;
}

double error_at(const UnitCellStudy& study, const UnitCellCurve& curve, double angle) {
  const double place = (angle / study.options.to + 1.0) * study.options.increments;
  const auto last = static_cast<double>(study.angle.size() - 2);
  const double before = std::clamp(std::floor(place), 0.0, last);
  const auto n = static_cast<std::size_t>(before);
  return curve.error[n] + (place - before) * (curve.error[n + 1] - curve.error[n]);
}

}  // namespace weaveform
