#include "post/unit_cell/closed_form.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/vector/angle.hpp"

namespace weaveform {

namespace {

// Ends of the law's pieces inside (0, end), with 0 and end: between two of them the stress is smooth. A friction-like
// start, g / (g + rise), bends over its rise: intervals that grow with the distance from it.
std::vector<double> smooth_intervals(const ShearCard& card, double end) {
  std::vector<double> knots = {0.0, end};
  for (const auto& piece : card.tangent.pieces()) {
    for (const double at : {piece.from, piece.to}) {
      if (at > 0.0 && at < end) knots.push_back(at);
    }
  }
  if (card.start.plateau > 0.0 && card.start.rise > 0.0)
    for (double at = card.start.rise; at < end; at *= 4.0) knots.push_back(at);
  std::sort(knots.begin(), knots.end());
  return knots;
}

// Gauss-Legendre with five points (Abramowitz & Stegun 1964, table 25.4) on each of 64 parts of every smooth interval:
// error of order (h/2)^10, far below rounding for the polynomials of Table 3.
template <class Function>
double integrate(const std::vector<double>& knots, const Function& function) {
  constexpr std::array<double, 3> point = {0.0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr std::array<double, 3> weight = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
  constexpr int parts = 64;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    const double half = 0.5 * (knots[k + 1] - knots[k]) / parts;
    for (int p = 0; p < parts; ++p) {
      const double centre = knots[k] + (2 * p + 1) * half;
      sum += half * weight[0] * function(centre);
      for (std::size_t i = 1; i < point.size(); ++i)
        sum += half * weight[i] * (function(centre - half * point[i]) + function(centre + half * point[i]));
    }
  }
  return sum;
}

double incremental_ratio(const ShearCard& card, double angle) {
  const double log_strain = log_shear_strain(angle), cosine = std::cos(angle);
  return 1.0 + std::sin(angle) * shear_energy(card, log_strain) / (shear_stress(card, log_strain) * cosine * cosine);
}

double side_frame_ratio(const ShearCard& card, double angle) {
  const double k = integrate(smooth_intervals(card, angle),
                             [&](double strain) { return shear_stress(card, strain) * std::cos(strain); });
  const double tangent = std::tan(angle);
  return ((1.0 - std::sin(angle) * tangent) * shear_stress(card, angle) + tangent * k) /
         (shear_stress(card, log_shear_strain(angle)) * std::cos(angle));
}

double constant_volume_ratio(const ShearCard& card, Formulation formulation, double angle) {
  if (formulation == Formulation::energy || formulation == Formulation::contravariant || angle == 0.0) return 1.0;
  return formulation == Formulation::incremental ? incremental_ratio(card, angle) : side_frame_ratio(card, angle);
}

}  // namespace

double analytical_shear_force(const Card& card, double angle) {
  return card.thickness * shear_stress(card.shear, log_shear_strain(angle));
}

double closed_form_ratio(const ShearCard& card, Formulation formulation, Thickness thickness, double angle) {
  const double ratio = constant_volume_ratio(card, formulation, std::abs(angle));
  return thickness == Thickness::constant ? ratio * std::cos(angle) : ratio;
}

double formulation_holds_to(const ShearCard& card, Formulation formulation, Thickness thickness, double tolerance) {
  constexpr int last = 89;  // deg; gL is 4.7 there, and infinite at 90
  const auto holds = [&](double angle) {
    // where a law gives no stress there is no ratio, and nothing wrong
    return !(std::abs(closed_form_ratio(card, formulation, thickness, angle) - 1.0) > tolerance);
  };
  int beyond = 1;
  while (beyond <= last && holds(beyond * degree)) ++beyond;
  if (beyond > last) return last * degree;
  double inside = (beyond - 1) * degree, outside = beyond * degree;
  while (outside - inside > 1e-9) {
    const double middle = 0.5 * (inside + outside);
    (holds(middle) ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace weaveform
