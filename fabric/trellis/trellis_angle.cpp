#include "fabric/trellis/trellis_angle.hpp"

#include <cmath>
#include <numbers>

namespace weaveform {

double trellis_shear_angle(double half_angle_cosine) {
  if (!(half_angle_cosine >= 0.0)) return std::nan("");
  return std::numbers::pi / 2.0 - 2.0 * std::acos(half_angle_cosine);
}

}  // namespace weaveform
