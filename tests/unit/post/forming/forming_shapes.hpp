// Fabric laid exactly on shapes, for tests of what is measured on a formed part. Units mm.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "mesher/scene/scene.hpp"
#include "post/forming/placed_tools.hpp"
#include "tests/unit/solver/lattice/trellis.hpp"

namespace weaveform::test {

// columns x columns crossings about the origin, warp along x.
inline Mesh centred_lattice(int columns, double spacing) {
  Mesh mesh = lattice(columns, columns, spacing);
  for (Vec3& x : mesh.nodes.position)
    for (int c = 0; c < 2; ++c) x[c] -= 0.5 * (columns - 1) * spacing;
  return mesh;
}

inline std::vector<Vec3> moved(const Mesh& mesh, const std::function<Vec3(const Vec3&)>& map) {
  std::vector<Vec3> position;
  for (const Vec3& x : mesh.nodes.position) position.push_back(map(x));
  return position;
}

// Onto the lower half of a sphere about the origin by the azimuthal equidistant map: arcs from the pole keep their
// length.
inline Vec3 on_bowl(const Vec3& x, double radius) {
  const double arc = std::hypot(x[0], x[1]), angle = arc / radius;
  if (arc == 0.0) return {0.0, 0.0, -radius};
  return {radius * std::sin(angle) * x[0] / arc, radius * std::sin(angle) * x[1] / arc, -radius * std::cos(angle)};
}

inline PlacedTool sphere_tool(double radius) {
  PlacedTool placed;
  placed.tool.name = "punch";
  placed.tool.shape = ToolShape::sphere;
  placed.tool.radius = radius;
  return placed;
}

inline PlacedTool plane_tool(double height) {
  PlacedTool placed;
  placed.tool.name = "plate";
  placed.tool.shape = ToolShape::plane;
  placed.place.origin = {0.0, 0.0, height};
  return placed;
}

inline ToolSpec tool_spec(const std::string& name, ToolShape shape, double travel) {
  ToolSpec tool;
  tool.name = name;
  tool.shape = shape;
  tool.travel = travel;
  tool.radius = 50.0;
  return tool;
}

}  // namespace weaveform::test
