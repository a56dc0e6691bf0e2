#include "solver/motion/loading.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/outline/blank_outline.hpp"
#include "solver/contact/tool_motion.hpp"
#include "solver/motion/grips.hpp"

namespace weaveform {
namespace {

constexpr double sampled_to = 0.8813735870195430;  // gamma_L at 45 deg; few parts shear more
constexpr int samples = 200;

double least_shear_tangent(const ShearCard& card) {
  double least = shear_tangent(card, 0.0);
  for (int n = 1; n <= samples; ++n) least = std::min(least, shear_tangent(card, sampled_to * n / samples));
  return std::max(least, 1e-3 * shear_tangent(card, 0.0));
}

}  // namespace

Loading choose_loading(const Scene& scene, const Card& card) {
  const auto extent = blank_extent(scene);
  const double length = std::max(extent[0], extent[1]);
  const double shear_stiffness = least_shear_tangent(card.shear) * card.thickness;  // N/mm
  Loading loading;
  loading.crossing_time = length * std::sqrt(card.area_density() / shear_stiffness);
  double travel = 0.0;
  for (const auto& grip : scene.grip) travel = std::max(travel, std::abs(grip.travel));
  if (scene.frame) travel = std::abs(scene.frame->travel);
  // A longer way takes longer: inertia forces go with travel / duration^2. Up to an eighth of the blank it costs
  // nothing.
  const double way = std::max(1.0, travel / (length / 8.0));
  loading.duration = default_crossings * loading.crossing_time * std::sqrt(way);
  double tool_way = 0.0;  // mm; travelled in the duration at the greatest speed
  for (const auto& tool : scene.tools)
    tool_way = std::max(tool_way, std::abs(tool.travel) * greatest_slope(tool.speed));
  if (tool_way > 0.0 && travel == 0.0) loading.duration = tool_way / default_tool_speed;
  if (scene.analysis.duration) loading.duration = *scene.analysis.duration;
  const double way_at_speed = std::max(smooth_step_greatest_slope * travel, tool_way);
  if (scene.analysis.loading_speed && way_at_speed > 0.0)
    loading.duration = way_at_speed / *scene.analysis.loading_speed;
  loading.damping = scene.analysis.damping.value_or(default_decays / loading.duration);
  return loading;
}

}  // namespace weaveform
