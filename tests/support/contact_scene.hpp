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

inline ToolSpec make_tool_spec(const std::string& name, ToolShape shape) {
  ToolSpec tool;
  tool.name = name;
  tool.shape = shape;
  return tool;
}

// A small deep drawing: sphere of 20 mm through a ring, 8 x 8 cells.
inline Scene drawing() {
  Scene scene = contact_scene({120.0, 120.0}, 3.0);
  ToolSpec binder = make_tool_spec("binder", ToolShape::ring), die = make_tool_spec("die", ToolShape::ring),
           punch = make_tool_spec("punch", ToolShape::sphere);
  binder.axis = {0.0, 0.0, -1.0};
  binder.opening_radius = die.opening_radius = 24.0;
  binder.force = 50.0;
  die.fillet_radius = 8.0;
  punch.radius = 20.0;
  punch.travel = 20.0;
  scene.analysis.loading_speed = 300.0;  // inertia well below a newton
  binder.friction = die.friction = punch.friction = 0.3;
  scene.tools = {binder, die, punch};
  return scene;
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
