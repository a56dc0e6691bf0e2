#include "fabric/trellis/bias_rectangle.hpp"

#include <cmath>
#include <numbers>

#include "fabric/trellis/trellis_angle.hpp"

namespace weaveform {
namespace {

using std::numbers::pi;
using std::numbers::sqrt2;

}  // namespace

double bias_shear_angle(const BiasRectangle& rectangle, double travel) {
  const double free = rectangle.free_length();
  return trellis_shear_angle((free + travel) / (sqrt2 * free));
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
