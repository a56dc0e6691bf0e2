#include "mesher/base/trellis.hpp"

#include <cmath>
#include <numbers>

namespace weaveform {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

// acos of a cosine beyond [0, 1] is an angle the trellis cannot have.
double shear_angle_of(double half_angle_cosine) {
  if (!(half_angle_cosine >= 0.0)) return std::nan("");
  return pi / 2.0 - 2.0 * std::acos(half_angle_cosine);
}

}  // namespace

double frame_shear_angle(const ShearFrame& frame, double displacement) {
  return shear_angle_of(displacement / (2.0 * frame.frame_length) + sqrt2 / 2.0);
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

double bias_shear_angle(const BiasRectangle& rectangle, double travel) {
  const double free = rectangle.free_length();
  return shear_angle_of((free + travel) / (sqrt2 * free));
}

double bias_travel(const BiasRectangle& rectangle, double angle) {
  return rectangle.free_length() * (sqrt2 * std::cos(pi / 4.0 - angle / 2.0) - 1.0);
}

BiasZones bias_zones(const BiasRectangle& rectangle) {
  const double width = rectangle.width, free = rectangle.free_length();
  // L > 2 W: the sides cut two corners off the diamond A; L < 2 W: they leave two unsheared triangles more of C.
  const double excess = free - width;
  const double corners = 0.5 * excess * excess;
  BiasZones zones;
  zones.a = 0.5 * free * free - (excess > 0.0 ? corners : 0.0);
  zones.c = 0.5 * width * width + (excess < 0.0 ? corners : 0.0);
  zones.b = width * rectangle.length - zones.a - zones.c;
  return zones;
}

BiasLoadWeights bias_load_weights(const BiasRectangle& rectangle, double thickness, double angle) {
  // D + delta = sqrt2 D cos(pi/4 - gamma/2)  =>  d gamma / d delta = sqrt2 / (D sin(pi/4 - gamma/2))
  const double angle_rate = sqrt2 / (rectangle.free_length() * std::sin(pi / 4.0 - angle / 2.0));  // 1/mm
  const BiasZones zones = bias_zones(rectangle);
  // Zone B shears by gamma/2, hence at half the rate.
  return {thickness * angle_rate * zones.a * std::cos(angle),
          0.5 * thickness * angle_rate * zones.b * std::cos(0.5 * angle)};
}

}  // namespace weaveform
