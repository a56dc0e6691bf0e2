#include "post/measure/bias_extension.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace weaveform {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Side {
  int axis;       // 0 = x, 1 = y
  double normal;  // sign of the outward normal along the axis
};

std::optional<Side> side_of(const std::string& edge) {
  if (edge == "bottom") return Side{1, -1.0};
  if (edge == "top") return Side{1, 1.0};
  if (edge == "left") return Side{0, -1.0};
  if (edge == "right") return Side{0, 1.0};
  return std::nullopt;
}

// +1 or -1 when the grip moves along the axis, out of or into the specimen; 0 when it moves any other way.
double outward_motion(const GripSpec& grip, const Side& side) {
  if (!grip.direction) return 1.0;
  const auto& d = *grip.direction;
  const double norm = std::hypot(d[0], d[1], d[2]);
  const double along = d[side.axis] * side.normal;
  if (std::abs(along) < (1.0 - 1e-9) * norm) return 0.0;
  return along > 0.0 ? 1.0 : -1.0;
}

bool holds_in_plane(const GripSpec& grip) {
  return std::none_of(grip.free.begin(), grip.free.end(), [](const std::string& c) { return c == "x" || c == "y"; });
}

bool yarns_at_45(double yarn_angle) {
  return std::abs(std::abs(std::remainder(yarn_angle, 90.0)) - 45.0) < 1e-6;
}

// Power per flat area of a zone and rate of its angle (N/mm): t sigma cos gamma, times cos gamma again when the
// thickness is constant, since the volume then shrinks with the area.
double power_per_area(const ShearCard& shear, double thickness, ShearThickness rule, double angle) {
  const double volume_ratio = rule == ShearThickness::constant ? std::cos(angle) : 1.0;
  return thickness * volume_ratio * shear_stress(shear, std::atanh(std::sin(angle))) * std::cos(angle);
}

}  // namespace

std::optional<BiasSpecimen> find_bias_extension(const Scene& scene) {
  if (scene.blank.shape != "rectangle" || !yarns_at_45(scene.blank.yarn_angle) || scene.grip.size() != 2)
    return std::nullopt;
  const GripSpec *low = &scene.grip[0], *high = &scene.grip[1];
  std::optional<Side> low_side = side_of(low->edge), high_side = side_of(high->edge);
  if (!low_side || !high_side || low_side->axis != high_side->axis || low_side->normal == high_side->normal)
    return std::nullopt;
  if (low_side->normal > 0.0) {
    std::swap(low, high);
    std::swap(low_side, high_side);
  }
  BiasSpecimen specimen;
  specimen.axis = low_side->axis;
  specimen.length = scene.blank.size[specimen.axis];
  specimen.width = scene.blank.size[1 - specimen.axis];
  specimen.grip = {low->name, high->name};
  specimen.outward = {outward_motion(*low, *low_side), outward_motion(*high, *high_side)};
  const bool along_the_pull = specimen.outward[0] != 0.0 && specimen.outward[1] != 0.0;
  if (!along_the_pull || !holds_in_plane(*low) || !holds_in_plane(*high) || specimen.length <= specimen.width)
    return std::nullopt;
  return specimen;
}

ZoneAreas zone_areas(const BiasSpecimen& specimen) {
  const double width = specimen.width, free = specimen.free_length();
  const double excess = free - width;  // > 0: the sides cut the diamond A; < 0: they leave unsheared triangles of C
  const double corner = 0.5 * excess * excess;
  ZoneAreas area;
  area.a = 0.5 * free * free - (excess > 0.0 ? corner : 0.0);
  area.c = 0.5 * width * width + (excess < 0.0 ? corner : 0.0);
  area.b = width * specimen.length - area.a - area.c;
  return area;
}

double kinematic_shear_angle(const BiasSpecimen& specimen, double travel) {
  const double free = specimen.free_length();
  const double cosine = (free + travel) / (free * std::numbers::sqrt2);
  if (!(cosine >= 0.0 && cosine <= 1.0)) return not_a_number;
  return std::numbers::pi / 2.0 - 2.0 * std::acos(cosine);
}

double inextensible_bias_load(const BiasSpecimen& specimen, const ShearCard& shear, double thickness,
                              ShearThickness rule, double travel) {
  const double angle = kinematic_shear_angle(specimen, travel);
  const double sine = std::sin(std::numbers::pi / 4.0 - angle / 2.0);
  if (!(sine > 0.0)) return not_a_number;
  // D + delta = sqrt2 D cos(pi/4 - gamma/2)  =>  d gamma / d delta = sqrt2 / (D sin(pi/4 - gamma/2))
  const double angle_rate = std::numbers::sqrt2 / (specimen.free_length() * sine);  // 1/mm
  const ZoneAreas area = zone_areas(specimen);
  // Zone B shears by gamma/2, hence at half the rate.
  return angle_rate * (area.a * power_per_area(shear, thickness, rule, angle) +
                       0.5 * area.b * power_per_area(shear, thickness, rule, 0.5 * angle));
}

}  // namespace weaveform
