#include "solver/analysis/loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/scene/taken.hpp"
#include "solver/bending/flexure.hpp"
#include "solver/constraint/grips.hpp"
#include "solver/contact/tool_motion.hpp"

namespace weaveform {
namespace {

constexpr double sampled_to = 0.8813735870195430;  // gamma_L at 45 deg; few parts shear more
constexpr int samples = 200;
constexpr double hinge_share = 0.25;  // of g/L; see loading.hpp

double least_shear_tangent(const ShearCard& card) {
  double least = shear_tangent(card, 0.0);
  for (int n = 1; n <= samples; ++n) least = std::min(least, shear_tangent(card, sampled_to * n / samples));
  return std::max(least, 1e-3 * shear_tangent(card, 0.0));
}

bool only_weight_acts(const Scene& scene) {
  const auto moves = [](const auto& part) { return part.travel != 0.0; };
  return scene.analysis.gravity != std::array<double, 3>{0.0, 0.0, 0.0} && scene.tools.empty() && !scene.frame &&
         std::none_of(scene.grip.begin(), scene.grip.end(), moves);
}

bool tools_alone_travel(const Scene& scene) {
  const auto travels = [](const auto& part) { return part.travel != 0.0; };
  return !scene.frame && std::none_of(scene.grip.begin(), scene.grip.end(), travels) &&
         std::any_of(scene.tools.begin(), scene.tools.end(), travels);
}

// What choose_loading goes by where the scene gives neither duration nor speed.
std::string by_what(const Scene& scene) {
  if (only_weight_acts(scene)) return "until the slowest sway of the blank has come to rest";
  if (tools_alone_travel(scene)) return fmt::format("so that no tool is faster than {:g} mm/s", default_tool_speed);
  return fmt::format("{:g} times as long as the slowest shear wave takes across the blank, and longer for a long way",
                     default_crossings);
}

// 1/mm; where the law reaches a moment (N mm), `most` if it does not before.
double curvature_at(const TangentLaw& law, double moment, double most) {
  double low = 0.0, high = most;
  if (law.stress(high) <= moment) return high;
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (law.stress(middle) < moment ? low : high) = middle;
  }
  return high;
}

// N mm^2; the least of the law's stiffness at rest, its secant and its tangent at the moment.
double stiffness_under(const TangentLaw& law, double moment, double most_curvature) {
  const double curvature = curvature_at(law, moment, most_curvature);
  const double loaded = std::min(law.stress(curvature) / curvature, law.tangent(curvature));
  return std::min(law.tangent(0.0), std::max(loaded, 0.0));
}

// 1/s; see loading.hpp.
double slowest_sway(const Scene& scene, const Card& card, double length) {
  const Flexure flexure = choose_flexure(card, scene);
  const auto& g = scene.analysis.gravity;
  const double gravity = std::hypot(g[0], g[1], g[2]);
  const double clamp_moment = 0.5 * gravity * card.area_density() * length * length;  // N; per width
  double rigidity = std::numeric_limits<double>::infinity();                          // N mm
  bool softens = false;
  for (std::size_t f = 0; f < 2; ++f) {
    const BendingLaw& law = (flexure.has_shell ? flexure.shell : flexure.out_of_plane)[f];
    const double interval = card.yarn[f].interval;
    for (const TangentLaw* half : {&law.face(), &law.back()}) {
      const double loaded = stiffness_under(*half, clamp_moment * interval, 1.0 / card.thickness);
      softens |= loaded < half->tangent(0.0);
      rigidity = std::min(rigidity, loaded / interval);
    }
  }
  const double hangs = (softens ? hinge_share : 1.0) * 1.446 * gravity / length;
  return std::sqrt(std::max(12.36 * rigidity / (card.area_density() * std::pow(length, 4)), hangs));
}

}  // namespace

double automatic_duration(const Scene& scene, const Card& card, const std::array<double, 2>& extent) {
  Scene free = scene;
  free.analysis.duration.reset();
  free.analysis.loading_speed.reset();
  return choose_loading(free, card, extent).duration;
}

Loading choose_loading(const Scene& scene, const Card& card, const std::array<double, 2>& extent) {
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
  const double sway = only_weight_acts(scene) ? slowest_sway(scene, card, length) : 0.0;
  if (sway > 0.0) loading.duration = default_settling / sway;
  if (scene.analysis.duration) loading.duration = *scene.analysis.duration;
  const double way_at_speed = std::max(smooth_step_greatest_slope * travel, tool_way);
  if (scene.analysis.loading_speed && way_at_speed > 0.0)
    loading.duration = way_at_speed / *scene.analysis.loading_speed;
  const double chosen = sway > 0.0 ? 2.0 * sway : default_decays / loading.duration;
  loading.damping = scene.analysis.damping.value_or(chosen);
  return loading;
}

double automatic_duration(const Resolved& model) {
  double longest = 0.0;
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    longest = std::max(longest, automatic_duration(ply.scene, ply.card, ply.extent()));
  }
  return longest;
}

Loading choose_loading(const Resolved& model) {
  Loading slowest;
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    const Loading own = choose_loading(ply.scene, ply.card, ply.extent());
    if (k == 0 || own.duration > slowest.duration) slowest = own;
  }
  return slowest;
}

std::string describe_automatic_duration(const Resolved& model) {
  const Scene& scene = model.scene;
  if (scene.analysis.duration || scene.analysis.loading_speed) return "";
  const bool open = leaves_open(scene, duration_key);
  std::string advice;
  if (open)
    advice =
        "; 'weaveform mesh' makes the trials that analysis.inertia asks for, and a scene.toml that has their duration";
  else if (tools_alone_travel(scene))
    advice = ", whatever inertia comes to; \"auto\" chooses it by inertia";
  return fmt::format("{} = {:.3g} s: {}, {}{}", duration_key, choose_loading(model).duration,
                     open ? "not by trials" : "left out", by_what(scene), advice);
}

}  // namespace weaveform
