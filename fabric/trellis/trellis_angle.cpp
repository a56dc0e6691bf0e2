#include "fabric/trellis/trellis_angle.hpp"

#include <cmath>
#include <numbers>

#include "core/missing.hpp"

namespace weaveform {

double trellis_shear_angle(double half_angle_cosine) {
  if (!(half_angle_cosine >= 0.0 && half_angle_cosine <= 1.0)) return missing;
  return std::numbers::pi / 2.0 - 2.0 * std::acos(half_angle_cosine);
}

}  // namespace weaveform
