// The fabric's shear law: Table 3 of the paper, with the logarithmic shear strain of its Eq. 6.
#pragma once

#include "fabric/law/tangent_law.hpp"

namespace weaveform {

// Friction-like start of a shear curve, added to the polynomial: stress = plateau * g / (g + rise), g = |log shear
// strain|.
struct ShearStart {
  double plateau = 0.0;  // MPa
  double rise = 0.0;     // 1
  bool operator==(const ShearStart&) const = default;
};

struct ShearCard {
  TangentLaw tangent;  // MPa against logarithmic engineering shear strain >= 0 (Table 3); odd in the strain's sign
  ShearStart start;    // absent when plateau == 0
  double valid_to_deg = 60;  // deg; the shear angle up to which the law is meant to hold; the law is checked up to here
  // mm/N; a in stress (1 + a T), T the tension per width, mean of warp and weft (fabric/trellis/tension_shear.hpp)
  double tension_coupling = 0.0;
  bool operator==(const ShearCard&) const = default;
};

// Logarithmic shear strain at a shear angle (rad): integral of Eq. 6, gamma_L = atanh(sin gamma).
[[nodiscard]] double log_shear_strain(double shear_angle);

// Total shear stress and tangent of the card (MPa) at a signed logarithmic shear strain, and the stored energy per
// reference volume (mJ/mm^3), w = integral of stress d(sin gamma) with sin gamma = tanh(strain), by quadrature to about
// 1e-12.
[[nodiscard]] double shear_stress(const ShearCard& card, double log_shear_strain);
[[nodiscard]] double shear_tangent(const ShearCard& card, double log_shear_strain);
[[nodiscard]] double shear_energy(const ShearCard& card, double log_shear_strain);

}  // namespace weaveform
