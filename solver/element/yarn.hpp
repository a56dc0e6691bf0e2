// Truss yarn (the paper's T3D2) or seatbelt, which differ in their law (yarn_law.hpp). True strain e = ln(L/L0) (paper,
// "Tensile characterization"), stress the integral of the tangent law. Axial force, with power N dL/dt:
//   incompressible section   A = A0 L0/L :  N = s(e) A0 L0/L
//   constant section         A = A0      :  N = s(e) A0
#pragma once

#include "mesher/scene/choices.hpp"
#include "solver/element/half_log.hpp"
#include "solver/element/inverse_root.hpp"

namespace weaveform {

// Force per length, N/L (N/mm): the nodal force is this times the vector between the nodes. `length_squared` is L^2,
// `rest` L0 and `excess` L^2 - L0^2, in mm, the last with all the digits that there are: the strain hangs on it. No square
// root is needed when the section is incompressible. Sets `inverse` to 1/L^2, which comes with the strain's own division.
// `near`: for (L/L0)^2 within half_log.hpp's near ratios, true strains of -0.137 to 0.138; the same bits sooner.
template <Section section, bool near = false, class Law, class T>
[[gnu::always_inline]] inline T yarn_force_per_length(const Law& law, const T& length_squared, const T& excess,
                                                      const T& rest, const T& area, T& inverse) {
  const HalfLog<T> parts = near ? near_half_log_parts<T>(length_squared, rest * rest, excess)
                                : half_log_parts<T>(length_squared, rest * rest, excess);
  const auto strain = [&](const T& ratio) __attribute__((always_inline)) {
    return near ? parts.near_value(ratio) : parts.value(ratio);
  };
  if constexpr (section == Section::incompressible) {
    const T both = 1.0 / (parts.denominator * length_squared);
    inverse = both * parts.denominator;
    const T ratio = parts.numerator * (both * length_squared);
    return (area * inverse) * (law.stress(strain(ratio)) * rest);
  } else {
    const T inverse_length = inverse_root(length_squared);
    inverse = inverse_length * inverse_length;
    const T ratio = parts.numerator / parts.denominator;
    return law.stress(strain(ratio)) * area * inverse_length;
  }
}

// A yarn that reaches `jaw` mm into a grip: strain and force of the whole length L + jaw, the force over L. `excess` is
// that of `whole` over `rest`, L0 + jaw; `inverse` as above, of L; `inverse_length` is 1/L.
template <Section section, bool near = false, class Law, class T>
[[gnu::always_inline]] inline T jawed_yarn_force_per_length(const Law& law, const T& whole, const T& excess,
                                                            const T& inverse_length, const T& rest, const T& area,
                                                            T& inverse) {
  T inverse_whole;
  const T per_whole =
      yarn_force_per_length<section, near, Law, T>(law, whole * whole, excess, rest, area, inverse_whole);
  inverse = inverse_length * inverse_length;
  return per_whole * whole * inverse_length;
}

// Axial viscosity, N_v = eta A0/L0 dL/dt, against the elements' highest modes alone: eta = beta E with E the stiffest
// tangent and beta = xi * stable step, so that xi is the fraction of critical damping at the highest frequency (the
// linear bulk viscosity of the explicit codes). Where a yarn's stiffness jumps between tension and slackness, leapfrog
// steps make energy from rounding noise without it. It acts in slack yarns too: a seatbelt that met its tension
// undamped made up to 5 % of a falling chain's energy (docs/theory.md). `rate` = d . dv, so that dL/dt = rate/L;
// `over_rest` is eta/L0 and `inverse` 1/L^2; returns N_v/L in N/mm.
template <class T>
[[gnu::always_inline]] inline T viscous_force_per_length(const T& inverse, const T& rate, const T& area,
                                                         const T& over_rest) {
  return (area * inverse) * (over_rest * rate);
}

}  // namespace weaveform
