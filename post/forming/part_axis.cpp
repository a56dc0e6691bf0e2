#include "post/forming/part_axis.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/vector/eigen_vector.hpp"
#include "solver/result/probe.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr double steepest = 0.5;  // least cosine between an axis and the blank's normal for it to cross the blank

Vector3d direction_in_plane(const BlankSpec& blank, double degrees) {
  const double angle = (blank.orientation + blank.yarn_angle + degrees) * std::numbers::pi / 180.0;
  return {std::cos(angle), std::sin(angle), 0.0};
}

bool on_blank(const BlankSpec& blank, const Vector3d& x) {
  const auto [a, b] = blank_coordinates(blank, {x.x(), x.y(), x.z()});
  return std::abs(a) <= 0.5 * blank.size[0] && std::abs(b) <= 0.5 * blank.size[1];
}

// Where the line meets the plane of the flat blank, if it does so steeply enough and on the blank.
std::optional<Vector3d> crossing(const BlankSpec& blank, const Vector3d& through, const Vector3d& along) {
  if (std::abs(along.z()) < steepest) return {};
  const Vector3d at = through + along * ((blank.position[2] - through.z()) / along.z());
  return on_blank(blank, at) ? std::optional(at) : std::nullopt;
}

}  // namespace

double PartAxis::azimuth(const Vector3d& x) const {
  const Eigen::Vector2d place = across(x);
  return std::atan2(place.y(), place.x());
}

Vector3d flat_warp(const BlankSpec& blank) {
  return direction_in_plane(blank, 0.0);
}

Vector3d flat_weft(const BlankSpec& blank) {
  return direction_in_plane(blank, 90.0);
}

int first_travelling_tool(const Scene& scene) {
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (scene.tools[t].travel != 0.0) return static_cast<int>(t);
  return -1;
}

PartAxis part_axis(const Scene& scene, const std::vector<Tool>& tools) {
  PartAxis axis;
  axis.origin = vector_of(scene.blank.position);
  if (const int t = first_travelling_tool(scene); t >= 0) {
    const Tool& tool = tools[t];
    for (const auto& along : {tool.start.axis, tool.direction}) {
      const auto at = crossing(scene.blank, vector_of(tool.start.origin), vector_of(along));
      if (!at) continue;
      axis.tool = tool.name;
      axis.origin = *at;
      axis.up = along[2] > 0.0 ? vector_of(along) : Vector3d(-vector_of(along));
      break;
    }
  }
  const Vector3d warp = flat_warp(scene.blank);
  axis.warp = (warp - warp.dot(axis.up) * axis.up).normalized();
  axis.weft = axis.up.cross(axis.warp);
  return axis;
}

}  // namespace weaveform
