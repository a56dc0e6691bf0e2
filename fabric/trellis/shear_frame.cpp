#include "fabric/trellis/shear_frame.hpp"

#include <cmath>
#include <numbers>

#include "fabric/trellis/trellis_angle.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

}  // namespace

double frame_shear_angle(const ShearFrame& frame, double displacement) {
  return trellis_shear_angle(displacement / (2.0 * frame.frame_length) + sqrt2 / 2.0);
}

double frame_displacement(const ShearFrame& frame, double angle) {
  return 2.0 * frame.frame_length * (std::cos(pi / 4.0 - angle / 2.0) - sqrt2 / 2.0);
}

double normalised_shear_force(const ShearFrame& frame, double load, double angle) {
  const double side_force = load / (2.0 * std::cos(pi / 4.0 - angle / 2.0));  // N; along a side of the frame
  return frame.frame_length / (frame.fabric_length * frame.fabric_length) * side_force;
}

double frame_load(const ShearFrame& frame, double normalised_force, double angle) {
  const double side_force = normalised_force * frame.fabric_length * frame.fabric_length / frame.frame_length;  // N
  return 2.0 * std::cos(pi / 4.0 - angle / 2.0) * side_force;
}

}  // namespace weaveform
