// Scenes of a piece of fabric and a few tools, run in memory.
#pragma once

#include <cmath>
#include <string>

#include "mesher/lattice/build.hpp"
#include "solver/solve.hpp"

namespace weaveform::test {

constexpr double gravity = 9810.0;  // mm/s^2

inline Scene contact_scene(std::array<double, 2> size, double coarsening) {
  Scene scene;
  scene.blank.size = size;
  scene.blank.yarn_angle = 0.0;
  scene.blank.coarsening = {coarsening, coarsening};
  scene.output = {.frames = 0, .history = 100, .contour_step = 5.0};
  return scene;
}

inline ToolSpec make_tool_spec(const std::string& name, const std::string& shape) {
  ToolSpec tool;
  tool.name = name;
  tool.shape = shape;
  return tool;
}

inline SolveResult run(const Scene& scene, int threads = 1) {
  const Card card = load_card(scene.fabric.material);
  return solve(build_mesh(scene, card), scene, card, "", {.threads = threads, .resume = false, .quiet = true});
}

// Mean displacement of all nodes.
inline Vec3 mean_displacement(const Mesh& mesh, const std::vector<Vec3>& position) {
  Vec3 mean = {0.0, 0.0, 0.0};
  for (int n = 0; n < mesh.node_count(); ++n)
    for (int c = 0; c < 3; ++c) mean[c] += (position[n][c] - mesh.nodes.position[n][c]) / mesh.node_count();
  return mean;
}

// The value of a history column at the row nearest to a part of the duration.
inline double at_part(const History& history, const std::string& column, double part) {
  const auto values = history.values(column);
  return values[static_cast<std::size_t>(std::lround(part * static_cast<double>(values.size() - 1)))];
}

}  // namespace weaveform::test
