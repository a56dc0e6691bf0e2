// The axis of a formed part, about which meridians, radii and draw-in are measured.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

// A right-handed frame: warp (of the flat blank, made square to the axis), weft beside it, up. The origin is where the
// axis meets the plane of the flat blank.
struct PartAxis {
  std::string tool;  // whose axis it is; "" for the blank's own
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d warp = Eigen::Vector3d::UnitX(), weft = Eigen::Vector3d::UnitY();

  [[nodiscard]] double height(const Eigen::Vector3d& x) const { return (x - origin).dot(up); }  // mm
  // Square to the axis, along warp and weft; mm.
  [[nodiscard]] Eigen::Vector2d across(const Eigen::Vector3d& x) const {
    return {(x - origin).dot(warp), (x - origin).dot(weft)};
  }
  [[nodiscard]] double radius(const Eigen::Vector3d& x) const { return across(x).norm(); }  // mm
  [[nodiscard]] double azimuth(const Eigen::Vector3d& x) const;                             // rad; from the warp
};

// The axis of the first tool that travels, through its position; where that does not cross the blank's plane (a
// cylinder lying on it), its direction of travel. Without such a tool, or when the axis misses the blank, the blank's
// normal through its centre. `up` points to the side the flat blank's normal does.
[[nodiscard]] PartAxis part_axis(const Scene& scene, const std::vector<Tool>& tools);

// The number of the first tool that travels; -1: none.
[[nodiscard]] int first_travelling_tool(const Scene& scene);

// Unit directions of warp and weft on the flat blank.
[[nodiscard]] Eigen::Vector3d flat_warp(const BlankSpec& blank);
[[nodiscard]] Eigen::Vector3d flat_weft(const BlankSpec& blank);

}  // namespace weaveform
