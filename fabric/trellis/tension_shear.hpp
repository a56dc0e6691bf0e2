// Shear of a fabric whose yarns are under tension, in closed form: a patch that is sheared evenly, as in a shear frame
// with a coupling of tension and shear in the card (ShearCard::tension_coupling).
//
// Per flat area, with e the strain of a family's yarns, s their stress, A/h their section over their interval and t the
// thickness, the fabric stores
//   E = t w(gamma) + sum_f (A/h)_f phi_f(e_f + d) ,   phi = integral of s, of pull alone ,   d = a/2 t w(gamma)
// so that, with T_f = (A/h)_f s_f(e_f + d) the tension per width and T the mean of warp and weft,
//   stress = 1/t dE/d(sin gamma) = sigma (1 + a T) ,   tension = dE/de = T_f .
// What raises the stress with the tension shortens the yarns with the shear: each is the other's reaction (Maxwell), and
// a law sigma (1 + a T) without the shortening has no energy. Under a given tension T stays as it is; in a frame whose
// arms keep the yarns' length it grows with the shear.
// Tensions are per unstretched width and times the stretch, 1 or 2 % above the force over that width.
#pragma once

#include <array>

#include "fabric/card/card.hpp"

namespace weaveform {

struct TensionedShear {
  double stress = 0.0;                    // MPa; contravariant, F_sh over t (Eq. 5)
  std::array<double, 2> tension = {};     // N/mm; T_f of warp and weft
  std::array<double, 2> shortening = {};  // 1; d, of each family
};

// At a shear angle (rad), the yarns held at these true strains.
[[nodiscard]] TensionedShear shear_at_strain(const Card& card, double angle, const std::array<double, 2>& strain);
// The same under given tensions T_f (N/mm).
[[nodiscard]] double shear_stress_at_tension(const Card& card, double angle, const std::array<double, 2>& tension);

}  // namespace weaveform
