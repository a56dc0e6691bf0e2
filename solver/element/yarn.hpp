// Truss yarn (the paper's T3D2) or seatbelt, which differ in their law (yarn_law.hpp). True strain e = ln(L/L0) (paper,
// "Tensile characterization"), stress the integral of the tangent law. Axial force, with power N dL/dt:
//   incompressible section   A = A0 L0/L :  N = s(e) A0 L0/L
//   constant section         A = A0      :  N = s(e) A0
#pragma once

#include <cmath>

#include "mesher/scene/choices.hpp"
#include "solver/element/vector_log.hpp"

namespace weaveform {

// Force per length, N/L (N/mm): the nodal force is this times the vector between the nodes. `length_squared` is L^2 and
// `rest` L0, in mm; no square root is needed when the section is incompressible.
template <Section section, class Law>
[[gnu::always_inline]] inline double yarn_force_per_length(const Law& law, double length_squared, double rest,
                                                           double area) {
  const double strain = 0.5 * vector_log(length_squared / (rest * rest));
  const double stress = law.stress(strain);
  if constexpr (section == Section::incompressible) return stress * area * rest / length_squared;
  return stress * area / std::sqrt(length_squared);
}

// A yarn that reaches `jaw` mm into a grip: strain and force of the whole length, L + jaw over L0 + jaw = `rest`.
template <Section section, class Law>
[[gnu::always_inline]] inline double yarn_force_per_length(const Law& law, double length_squared, double rest,
                                                           double jaw, double area) {
  const double length = std::sqrt(length_squared);
  const double whole = length + jaw;
  const double per_whole = yarn_force_per_length<section>(law, whole * whole, rest, area);
  return per_whole * whole / length;
}

// Axial viscosity, N_v = eta A0/L0 dL/dt, against the elements' highest modes alone: eta = beta E with E the stiffest
// tangent and beta = xi * stable step, so that xi is the fraction of critical damping at the highest frequency (the
// linear bulk viscosity of the explicit codes). Where a yarn's stiffness jumps between tension and slackness, leapfrog
// steps make energy from rounding noise without it. It acts in slack yarns too: a seatbelt that met its tension
// undamped made up to 5 % of a falling chain's energy (docs/theory.md). `rate` = d . dv, so that dL/dt = rate/L;
// returns N_v/L in N/mm.
[[gnu::always_inline]] inline double viscous_force_per_length(double length_squared, double rate, double rest,
                                                              double area, double viscosity) {
  return viscosity * area * rate / (rest * length_squared);
}

}  // namespace weaveform
