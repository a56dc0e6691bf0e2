#include "post/measure/bias_extension.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/missing.hpp"

namespace weaveform {

namespace {

struct Side {
  int axis;       // 0 = x, 1 = y
  double normal;  // sign of the outward normal along the axis
};

std::optional<Side> side_of(std::optional<BlankEdge> edge) {
  if (edge == BlankEdge::bottom) return Side{1, -1.0};
  if (edge == BlankEdge::top) return Side{1, 1.0};
  if (edge == BlankEdge::left) return Side{0, -1.0};
  if (edge == BlankEdge::right) return Side{0, 1.0};
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
  return std::none_of(grip.free.begin(), grip.free.end(), [](Component c) { return c != Component::z; });
}

bool yarns_at_45(double yarn_angle) {
  return std::abs(std::abs(std::remainder(yarn_angle, 90.0)) - 45.0) < 1e-6;
}

// The card's stress at a shear angle, times cos gamma when the thickness is constant: the volume then shrinks with the
// area.
double effective_stress(const ShearCard& shear, Thickness rule, double angle) {
  const double stress = shear_stress(shear, std::atanh(std::sin(angle)));
  return rule == Thickness::constant ? stress * std::cos(angle) : stress;
}

}  // namespace

std::optional<BiasSpecimen> find_bias_extension(const Scene& scene) {
  if (scene.blank.shape != BlankShape::rectangle || !yarns_at_45(scene.blank.yarn_angle) || scene.grip.size() != 2)
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

std::optional<BiasSpecimen> find_bias_extension(const std::vector<const Scene*>& plies) {
  const auto first = find_bias_extension(*plies.front());
  const bool all_alike =
      std::all_of(plies.begin(), plies.end(), [&](const Scene* ply) { return find_bias_extension(*ply) == first; });
  return all_alike ? first : std::nullopt;
}

double inextensible_bias_load(const BiasSpecimen& specimen, const ShearCard& shear, double thickness, Thickness rule,
                              double travel) {
  const double angle = kinematic_shear_angle(specimen, travel);
  if (!(angle < std::numbers::pi / 2.0)) return missing;
  const BiasLoadWeights weights = bias_load_weights(specimen.rectangle(), thickness, angle);
  return weights.full * effective_stress(shear, rule, angle) +
         weights.half * effective_stress(shear, rule, 0.5 * angle);
}

}  // namespace weaveform
