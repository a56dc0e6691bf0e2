// Shear laws as they are fitted: a polynomial of the stress through zero, perhaps with a friction-like start, by least
// squares on anything linear in the stress at an angle and at half that angle, with a tangent that stays positive.
#pragma once

#include <string>
#include <vector>

#include "fabric/card/card.hpp"

namespace weaveform::identify {

// What the stress at one strain counts in what is observed.
struct StressWeight {
  double strain = 0.0;  // 1
  double weight = 0.0;  // 1, or mm^2 for a load
};

// value = full * stress(g(angle)) + half * stress(g(angle/2)), g = atanh(sin(angle)).
// Shear frame: the stress itself (full = 1, half = 0). Bias extension: the load, with the weights of its zones.
// Simulated test: value = shift + sum of weight * stress(strain) over `counted`, which is then not empty
// (simulated_fit.hpp).
struct ShearObservation {
  double angle = 0.0;             // rad; of a simulated test the one that the travel would give a trellis
  double full = 1.0, half = 0.0;  // 1, or mm^2 for a load
  double value = 0.0;             // MPa, or N for a load
  std::vector<StressWeight> counted = {};
  double shift = 0.0;  // MPa or N; what else than shear bears
};

struct ShearForm {
  int degree = 4;      // of the stress polynomial
  bool start = false;  // plateau g / (g + rise) beside it
  [[nodiscard]] int parameters() const { return degree + (start ? 2 : 0); }
};

struct ShearCurve {
  Polynomial stress;  // MPa; stress[0] = 0
  ShearStart start;
};
[[nodiscard]] double stress_of(const ShearCurve& curve, double strain);   // MPa; strain >= 0
[[nodiscard]] double tangent_of(const ShearCurve& curve, double strain);  // MPa
[[nodiscard]] double predicted(const ShearCurve& curve, const ShearObservation& observation);
// The greatest strain at which an observation tells of the stress.
[[nodiscard]] double greatest_strain(const ShearObservation& observation);
// Strains in [0, end] where the tangent is negative.
[[nodiscard]] std::vector<Interval> negative_tangent(const ShearCurve& curve, double end);

struct ShearCurveFit {
  ShearCurve curve;
  double squares = 0.0;                 // sum of squared residuals, in the observations' unit squared
  bool constrained = false;             // the tangent of the free fit turned negative
  std::vector<Interval> free_negative;  // where it did
  double free_squares = 0.0;            // its sum of squared residuals
};

// The best curve of a form whose tangent is positive from zero strain to the greatest observed. With a
// start the curve is linear in all but the rise, which is searched (variable projection, Golub & Pereyra 1973) between
// a quarter of the smallest strain observed and 0.2. Throws InputError when the observations cannot tell the
// coefficients.
[[nodiscard]] ShearCurveFit fit_shear_curve(const std::vector<ShearObservation>& observations, const ShearForm& form);

// d stress / d parameter at a strain, for the parameters (plateau, rise,) c1 ... c_degree.
[[nodiscard]] std::vector<double> sensitivities(const ShearCurve& curve, const ShearForm& form, double strain);
// d value / d parameter of an observation.
[[nodiscard]] std::vector<double> sensitivities(const ShearCurve& curve, const ShearForm& form,
                                                const ShearObservation& observation);

}  // namespace weaveform::identify
