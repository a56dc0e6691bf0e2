// The bias extension: Eq. 14 of the paper for any length-to-width ratio, of a pin-jointed trellis of inextensible
// yarns, and the load that it takes. Lengths in mm, angles in rad, forces in N. Angles that the trellis cannot have are
// not a number.
#pragma once

namespace weaveform {

// Rectangle of fabric pulled along its length, yarns at 45 deg to the pull.
struct BiasRectangle {
  double width = 0.0;                                                  // mm; W
  double length = 0.0;                                                 // mm; L > W, from grip to grip
  [[nodiscard]] double free_length() const { return length - width; }  // mm; D, the diagonal of zone A
};

// Eq. 14 with W replaced by D = L - W, which is W in the paper's specimen (L = 2 W):
//   gamma = pi/2 - 2 acos((D + delta) / (sqrt(2) D)).
[[nodiscard]] double bias_shear_angle(const BiasRectangle& rectangle, double travel);
// Its inverse: delta = D (sqrt(2) cos(pi/4 - gamma/2) - 1).
[[nodiscard]] double bias_travel(const BiasRectangle& rectangle, double angle);

// Flat areas (mm^2) of the three zones: A sheared by gamma, B by gamma/2, C not at all. A + B + C = L W.
struct BiasZones {
  double a = 0.0, b = 0.0, c = 0.0;
};
[[nodiscard]] BiasZones bias_zones(const BiasRectangle& rectangle);

// The load is linear in the shear stress at the two angles: F = full sigma(gamma) + half sigma(gamma/2), mm^2 each.
// From the power balance F d delta = t (A sigma(gamma) cos gamma d gamma + B sigma(gamma/2) cos(gamma/2) d(gamma/2)),
// constant volume, sigma the contravariant stress of Eq. 5; derivation in docs/bias_extension.md.
struct BiasLoadWeights {
  double full = 0.0, half = 0.0;
};
[[nodiscard]] BiasLoadWeights bias_load_weights(const BiasRectangle& rectangle, double thickness, double angle);

}  // namespace weaveform
