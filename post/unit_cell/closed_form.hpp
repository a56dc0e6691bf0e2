// What each formulation returns from a unit cell in the limit of fine increments, as formulas. Derived in
// docs/unit_cell.md; sigma is the card's stress, gamma the shear angle, gL = atanh(sin gamma) (Eq. 6).
#pragma once

#include "fabric/card/card.hpp"
#include "mesher/scene/choices.hpp"

namespace weaveform {

// The analytical response: F_sh = t sigma(gL), N/mm (Eq. 5 and the definition of sigma below it).
[[nodiscard]] double analytical_shear_force(const Card& card, double angle);

// Returned over analytical force, 1 at angle 0. At constant volume
//   energy, contravariant   1
//   incremental             1 + sin(gamma) w / (sigma(gL) cos^2 gamma),   w = integral_0^gamma sigma(gL') d(sin gamma')
//   side-frame              [(1 - sin gamma tan gamma) sigma(gamma) + tan(gamma) K] / (sigma(gL) cos gamma),
//                           K = integral_0^gamma sigma(g') cos g' dg'
// and cos(gamma) times that at constant thickness. Even in the angle (rad), |angle| < pi/2.
[[nodiscard]] double closed_form_ratio(const ShearCard& card, Formulation formulation, Thickness thickness,
                                       double angle);

// rad; the angle up to which |closed_form_ratio - 1| stays within `tolerance`, found to 1e-9; 89 deg if it never
// leaves.
[[nodiscard]] double formulation_holds_to(const ShearCard& card, Formulation formulation, Thickness thickness,
                                          double tolerance);

}  // namespace weaveform
