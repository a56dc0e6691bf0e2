// The shear angle of a trellis from half the angle between its yarns, which Eqs. 12 and 14 of the paper share.
#pragma once

namespace weaveform {

// rad; gamma = pi/2 - 2 acos(c). Not a number for a cosine beyond [0, 1]: an angle the trellis cannot have.
[[nodiscard]] double trellis_shear_angle(double half_angle_cosine);

}  // namespace weaveform
