// A moment-curvature curve as measured: monotone, through zero, with a stiffness that is linear between knots; odd, or one
// for each sense of bending.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fabric/law/tangent_law.hpp"

namespace weaveform::identify {

// dM/dkappa at the knots, linear between them and constant beyond the last; M(-kappa) = -M(kappa).
struct BendingCurve {
  std::vector<double> knot;                                 // 1/mm; rising from 0; two at least
  std::vector<double> tangent;                              // N mm; > 0
  [[nodiscard]] double moment(double curvature) const;      // N
  [[nodiscard]] double tangent_at(double curvature) const;  // N mm
  [[nodiscard]] double curvature(double moment) const;      // 1/mm; the inverse
};

// The curve of one yarn whose fabric has it per width, `interval` (mm) apart: N mm^2. Numbers of ten digits.
[[nodiscard]] std::vector<TangentPiece> pieces_of(const BendingCurve& curve, double interval);

// One reading; `friction` is the share of the greatest friction moment that acts there (friction_share), of either sign.
struct BendingReading {
  double curvature = 0.0;  // 1/mm
  double moment = 0.0;     // N; per width
  double friction = 0.0;   // 1
};

struct BendingCurveFit {
  BendingCurve curve;      // of a two-sided fit that of positive curvatures
  BendingCurve back = {};  // of a two-sided fit, that of negative ones, counted positive; the same knots
  double friction = 0.0;   // N; greatest moment of friction, 0 without
  double offset = 0.0;     // N; of the moment's zero, where readings of both senses tell it
  double misfit = 0.0;     // N; root mean square of the residuals
  // For the error of the curve: what each unknown (tangents at `error_knot`; friction, offset) does to each reading, and
  // what is left of it. The knots are those of the curve and one between every two: where the curve's own knots lie was
  // found from the same readings, and what it is between them nobody knows. Neighbouring readings are averaged where
  // there are many. Of a two-sided fit the tangents of `curve` come first, then those of `back`.
  std::vector<double> error_knot;
  Eigen::MatrixXd sensitivity;
  Eigen::VectorXd residual;
};

struct BendingFitChoices {
  int pieces = 12;         // at most, with the constant one beyond the last knot; 2 at least
  bool friction = false;   // readings' shares count
  bool offset = false;     // the moment's zero is unknown
  bool two_sided = false;  // a curve for each sense; friction and offset are theirs in common
  bool stiff_start =
      true;              // the first tangent is no less than the second: few readings tell it, and a toe is taken out
  double enough = 2e-4;  // of the greatest moment; a misfit (root mean square) that needs no more pieces
};

// The least-squares curve. Tangents are at least a ten-thousandth of the mean one, so that the moment rises everywhere
// (a nonnegative least-squares problem, Lawson & Hanson 1974, chapter 23). Knots are set one by one where they lower the
// sum of squares most, moved, and kept while Schwarz's criterion (1978) falls or until the misfit is `enough`.
[[nodiscard]] BendingCurveFit fit_bending_curve(const std::vector<BendingReading>& readings,
                                                const BendingFitChoices& choices);

// M's derivatives by the tangents at knots, at one curvature.
[[nodiscard]] Eigen::VectorXd curve_sensitivity(const std::vector<double>& knot, double curvature);

// Dahl's friction (1968) in bending along a record of curvatures, as a share phi of the greatest moment:
//   dphi = (1 - phi sign(dkappa)) dkappa / rise , so that over a step  phi -> s + (phi - s) exp(-|dkappa|/rise) .
// `start`: the share at the first reading.
[[nodiscard]] std::vector<double> friction_share(const std::vector<double>& curvature, double rise, double start);

}  // namespace weaveform::identify
