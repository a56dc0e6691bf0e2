// Truss yarn (the paper's T3D2) or seatbelt, which differ in their law (yarn_law.hpp). True strain e = ln(L/L0) (paper,
// "Tensile characterization"), stress the integral of the tangent law. Axial force, with power N dL/dt:
//   incompressible section   A = A0 L0/L :  N = s(e) A0 L0/L
//   constant section         A = A0      :  N = s(e) A0
#pragma once

#include <cmath>

#include "mesher/scene/choices.hpp"
#include "solver/element/half_log.hpp"

namespace weaveform {

// Force per length, N/L (N/mm): the nodal force is this times the vector between the nodes. `length_squared` is L^2 and
// `rest` L0, in mm; no square root is needed when the section is incompressible. Sets `inverse` to 1/L^2, which comes
// with the strain's own division: one for four made the loop a seventh faster.
template <Section section, class Law>
[[gnu::always_inline]] inline double yarn_force_per_length(const Law& law, double length_squared, double rest,
                                                           double area, double& inverse) {
  const HalfLog strain = half_log_parts(length_squared, rest * rest);
  const double both = 1.0 / (strain.denominator * length_squared);
  inverse = both * strain.denominator;
  const double stress = law.stress(strain.value(strain.numerator * (both * length_squared)));
  if constexpr (section == Section::incompressible) return stress * area * rest * inverse;
  return stress * area * std::sqrt(inverse);
}

// A yarn that reaches `jaw` mm into a grip: strain and force of the whole length, L + jaw over L0 + jaw = `rest`.
// `inverse` as above.
template <Section section, class Law>
[[gnu::always_inline]] inline double yarn_force_per_length(const Law& law, double length_squared, double rest,
                                                           double jaw, double area, double& inverse) {
  const double length = std::sqrt(length_squared);
  const double whole = length + jaw;
  double inverse_whole = 0.0;
  const double per_whole = yarn_force_per_length<section>(law, whole * whole, rest, area, inverse_whole);
  const double inverse_length = 1.0 / length;
  inverse = inverse_length * inverse_length;
  return per_whole * whole * inverse_length;
}

// Axial viscosity, N_v = eta A0/L0 dL/dt, against the elements' highest modes alone: eta = beta E with E the stiffest
// tangent and beta = xi * stable step, so that xi is the fraction of critical damping at the highest frequency (the
// linear bulk viscosity of the explicit codes). Where a yarn's stiffness jumps between tension and slackness, leapfrog
// steps make energy from rounding noise without it. It acts in slack yarns too: a seatbelt that met its tension
// undamped made up to 5 % of a falling chain's energy (docs/theory.md). `rate` = d . dv, so that dL/dt = rate/L;
// `over_rest` is eta/L0 and `inverse` 1/L^2; returns N_v/L in N/mm.
[[gnu::always_inline]] inline double viscous_force_per_length(double inverse, double rate, double area,
                                                              double over_rest) {
  return over_rest * area * rate * inverse;
}

}  // namespace weaveform
