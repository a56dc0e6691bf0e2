#include "fabric/law/shear_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace weaveform {

double log_shear_strain(double shear_angle) {
  return std::atanh(std::sin(shear_angle));
}

// The law is given for g >= 0 and odd in the strain's sign.
double shear_stress(const ShearCard& card, double log_shear_strain) {
  const double g = std::abs(log_shear_strain);
  const double start = card.start.plateau > 0.0 ? card.start.plateau * g / (g + card.start.rise) : 0.0;
  return std::copysign(card.tangent.stress(g) + start, log_shear_strain);
}

// d/dg of plateau g / (g + rise) = plateau rise / (g + rise)^2
double shear_tangent(const ShearCard& card, double log_shear_strain) {
  const double g = std::abs(log_shear_strain);
  const double reach = g + card.start.rise;
  const double start = card.start.plateau > 0.0 ? card.start.plateau * card.start.rise / (reach * reach) : 0.0;
  return card.tangent.tangent(g) + start;
}

namespace {

// dw/dg = stress(g) d(tanh g)/dg
double energy_rate(const ShearCard& card, double g) {
  const double cosh_g = std::cosh(g);
  return shear_stress(card, g) / (cosh_g * cosh_g);
}

// Gauss-Legendre with five points on [a, b] (Abramowitz & Stegun 1964, table 25.4), exact to degree nine.
double gauss(const ShearCard& card, double a, double b) {
  constexpr std::array<double, 3> point = {0.0, 0.53846931010568309104, 0.90617984593866399280};
  constexpr std::array<double, 3> weight = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
  const double centre = 0.5 * (a + b), half = 0.5 * (b - a);
  double sum = weight[0] * energy_rate(card, centre);
  for (std::size_t i = 1; i < point.size(); ++i) {
    sum += weight[i] * (energy_rate(card, centre - half * point[i]) + energy_rate(card, centre + half * point[i]));
  }
  return half * sum;
}

// Halves the interval until both halves together agree with the whole to `tolerance`; 40 halvings end any interval.
double integrate(const ShearCard& card, double a, double b, double whole, double tolerance, int depth) {
  const double middle = 0.5 * (a + b);
  const double left = gauss(card, a, middle), right = gauss(card, middle, b);
  if (depth == 0 || std::abs(left + right - whole) <= tolerance) return left + right;
  return integrate(card, a, middle, left, 0.5 * tolerance, depth - 1) +
         integrate(card, middle, b, right, 0.5 * tolerance, depth - 1);
}

}  // namespace

double shear_energy(const ShearCard& card, double log_shear_strain) {
  const double g = std::abs(log_shear_strain);
  // Pieces are integrated one by one: the tangent may jump where they join.
  std::vector<double> knots = {0.0, g};
  for (const auto& piece : card.tangent.pieces()) {
    for (const double end : {piece.from, piece.to}) {
      if (end > 0.0 && end < g) knots.push_back(end);
    }
  }
  std::sort(knots.begin(), knots.end());
  double energy = 0.0;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double whole = gauss(card, knots[i], knots[i + 1]);
    const double tolerance = std::max(1e-13 * std::abs(whole), std::numeric_limits<double>::min());
    energy += integrate(card, knots[i], knots[i + 1], whole, tolerance, 40);
  }
  return energy;
}

}  // namespace weaveform
