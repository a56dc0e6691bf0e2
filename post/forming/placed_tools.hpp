// The scene's tools where they stand at the moment of a frame, and the gap between them and the fabric.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct PlacedTool {
  Tool tool;
  Placement place;
};

// Displacements from the history, between its rows in a straight line. Throws InputError when it lacks a column.
[[nodiscard]] std::vector<PlacedTool> place_tools(const std::vector<Tool>& tools, const History& history, double time);

// How far each has moved since the start, mm. Throws likewise.
[[nodiscard]] std::vector<Vec3> displacements(const std::vector<Tool>& tools, const History& history, double time);

struct Gap {
  double gap = 0.0;                                  // mm; from the fabric's face to the tool, negative inside it
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit; outwards from the tool
};

[[nodiscard]] Gap gap_to(const PlacedTool& tool, const Eigen::Vector3d& x);
// The number of the tool that is nearest to x; -1 without tools.
[[nodiscard]] int nearest_tool(const std::vector<PlacedTool>& tools, const Eigen::Vector3d& x);

}  // namespace weaveform
