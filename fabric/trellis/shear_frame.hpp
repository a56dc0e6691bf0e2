// The shear (picture) frame: Eqs. 12 and 13 of the paper, of a pin-jointed trellis of inextensible yarns. Lengths in
// mm, angles in rad, forces in N. Angles that the trellis cannot have are not a number.
#pragma once

namespace weaveform {

// Shear frame of side L_F, driven along its diagonal, around a square of fabric of side L_f.
struct ShearFrame {
  double frame_length = 0.0;   // mm; L_F, between the pins
  double fabric_length = 0.0;  // mm; L_f
};

// Eq. 12: gamma = pi/2 - 2 acos(delta / (2 L_F) + sqrt(2)/2).
[[nodiscard]] double frame_shear_angle(const ShearFrame& frame, double displacement);
// Its inverse: delta = 2 L_F (cos(pi/4 - gamma/2) - sqrt(2)/2).
[[nodiscard]] double frame_displacement(const ShearFrame& frame, double angle);
// Eq. 13: F_sh = L_F / L_f^2 * F / (2 cos(pi/4 - gamma/2)), N/mm.
[[nodiscard]] double normalised_shear_force(const ShearFrame& frame, double load, double angle);
// Its inverse: the load of the frame (N) at a normalised shear force (N/mm).
[[nodiscard]] double frame_load(const ShearFrame& frame, double normalised_force, double angle);

}  // namespace weaveform
