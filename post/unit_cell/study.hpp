// Every variant of the shear cell through the unit cell, in both senses, beside the analytical response.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/scene/choices.hpp"

namespace weaveform {

struct CellShape {
  std::string name;                      // "square", "rectangular"
  std::array<double, 2> sides = {0, 0};  // mm; along the warp and along the weft
};

// A square of the warp's interval, and the card's own intervals (a cell along the warp is as long as the weft's
// interval); where these are a square too, the side along the weft is doubled, as a coarsening of 2 would.
[[nodiscard]] std::array<CellShape, 2> cell_shapes(const Card& card);

// What the study crosses. Cell kinds, formulations and thickness rules are the values of the scene's [model].
struct UnitCellOptions {
  double to = 0.0;     // rad; shear angle in either sense, 0 < to < pi/2
  int increments = 0;  // from 0 to `to`
  std::vector<CellElement> cells = {CellElement::membrane};
  std::vector<Formulation> formulations = {Formulation::energy, Formulation::contravariant, Formulation::incremental,
                                           Formulation::side_frame};
  std::vector<Thickness> thicknesses = {Thickness::constant_volume, Thickness::constant};
};

struct UnitCellVariant {
  CellShape shape;
  CellElement cell = CellElement::membrane;
  Formulation formulation = Formulation::energy;
  Thickness thickness = Thickness::constant_volume;
  // "square.membrane.energy.constant-volume": heads the variant's columns
  [[nodiscard]] std::string name() const;
};

// Index n runs over the study's angles.
struct UnitCellCurve {
  UnitCellVariant variant;
  std::vector<double> force;  // N/mm; returned
  std::vector<double> error;  // 1; returned / analytical - 1; 0 at angle 0
  double holds_to = 0.0;      // rad; |error| <= tolerance up to here in both senses; options.to if it never leaves
  double closed_form_distance = 0.0;  // 1; greatest |returned/analytical - closed_form_ratio|
};

// Returned / analytical at one angle with ever smaller increments.
struct ConvergenceRow {
  int increments = 0;
  double ratio = 0.0;
  double distance = 0.0;  // |ratio - closed form|
  double order = 0.0;     // log2 of the last distance over this one; NaN in the first row or at rounding
};
struct UnitCellConvergence {
  UnitCellVariant variant;
  double angle = 0.0;         // rad
  double closed_form = 0.0;   // ratio
  double extrapolated = 0.0;  // ratio; Richardson 1911 from the last two rows, second order
  std::vector<ConvergenceRow> row;
};

// What a rigid rotation by 90 deg during the shear changes: objective formulations lose it with the increments.
struct RotationRow {
  int increments = 0;
  double still = 0.0, rotated = 0.0;  // returned / analytical without and with the rotation
};
struct RotationCost {
  UnitCellVariant variant;
  double angle = 0.0;  // rad
  std::vector<RotationRow> row;
};

struct UnitCellStudy {
  Card card;
  UnitCellOptions options;
  std::vector<double> angle;       // rad; rising from -to over 0 to +to, 2 increments + 1 of them
  std::vector<double> analytical;  // N/mm
  std::vector<UnitCellCurve> curve;
  std::vector<UnitCellConvergence> convergence;  // of the formulations that count in increments
  std::vector<RotationCost> rotation;            // of the same
};

inline constexpr double unit_cell_tolerance = 0.05;  // 1; "stays within 5 %"

// Throws InputError when a law of the card does not fit the inner loop.
[[nodiscard]] UnitCellStudy study_unit_cell(const Card& card, const UnitCellOptions& options);

// The error at an angle (rad), linear between increments. The angle must lie within the study's.
[[nodiscard]] double error_at(const UnitCellStudy& study, const UnitCellCurve& curve, double angle);

}  // namespace weaveform
