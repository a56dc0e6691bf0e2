#include "mesher/tools/tool.hpp"

#include <cmath>
#include <map>

#include "mesher/base/error.hpp"

namespace weaveform {
namespace {

using Vector = std::array<double, 3>;

Vector unit(const Vector& a, double sign = 1.0) {
  const double size = std::hypot(a[0], a[1], a[2]);
  return {sign * a[0] / size, sign * a[1] / size, sign * a[2] / size};
}

ToolShape shape_of(const std::string& word) {
  static const std::map<std::string, ToolShape> shapes = {
      {"plane", ToolShape::plane}, {"sphere", ToolShape::sphere},     {"cylinder", ToolShape::cylinder},
      {"ring", ToolShape::ring},   {"revolved", ToolShape::revolved}, {"triangles", ToolShape::triangles}};
  const auto found = shapes.find(word);
  if (found == shapes.end()) throw InputError("no tool has the shape '" + word + "'");
  return found->second;
}

// The way the tool faces.
Vector default_direction(const Tool& tool) {
  switch (tool.shape) {
    case ToolShape::plane:
    case ToolShape::ring:
      return tool.start.axis;
    case ToolShape::sphere:
      return unit(tool.start.axis, -1.0);
    default:
      return {0.0, 0.0, -1.0};
  }
}

// Touching the flat blank at its centre, from the side that its axis says.
Vector touching_position(const Tool& tool, const BlankSpec& blank) {
  Vector position = blank.position;
  const double up = tool.start.axis[2] > 0.0 ? 1.0 : -1.0;
  position[2] += tool.shape == ToolShape::sphere ? up * (tool.radius + tool.offset) : -up * tool.offset;
  return position;
}

Tool make_tool(const ToolSpec& spec, const Scene& scene, double thickness) {
  const std::string where = (scene.file.empty() ? "" : scene.file + ": ") + "[tools." + spec.name + "]";
  Tool tool;
  tool.name = spec.name;
  tool.shape = shape_of(spec.shape);
  tool.start.axis = unit(spec.axis);
  tool.offset = spec.offset.value_or(0.5 * thickness);
  tool.friction = spec.friction;
  tool.fillet_radius = spec.fillet_radius;
  tool.radius = tool.shape == ToolShape::ring ? spec.opening_radius.value_or(0.0) : spec.radius.value_or(0.0);
  if (tool.shape == ToolShape::revolved) tool.profile = make_profile(spec.profile, where + " profile");
  if (tool.shape == ToolShape::triangles) {
    tool.start.axis = {0.0, 0.0, 1.0};
    const auto file = tool_path(spec.file, scene.file);
    tool.surface = std::make_shared<TriangleSurface>(read_stl(file), where + " " + file.string());
  }
  tool.direction = spec.direction ? unit(*spec.direction) : default_direction(tool);
  if (spec.position)
    tool.start.origin = *spec.position;
  else if (tool.shape != ToolShape::triangles)
    tool.start.origin = touching_position(tool, scene.blank);
  return tool;
}

void triangle_distances(const TriangleSurface& surface, const Placement& place, const Coordinates& x, int count,
                        int* hint, Distances& out) {
  for (int n = 0; n < count; ++n) {
    const Vector local = {x[0][n] - place.origin[0], x[1][n] - place.origin[1], x[2][n] - place.origin[2]};
    const SurfaceDistance found = surface.distance(local, hint == nullptr ? 0 : hint[n]);
    if (hint != nullptr) hint[n] = found.triangle;
    out.distance[n] = found.distance;
    for (int c = 0; c < 3; ++c) out.normal[c][n] = found.normal[c];
  }
}

}  // namespace

std::vector<Tool> make_tools(const Scene& scene, double thickness) {
  std::vector<Tool> tools;
  for (const auto& spec : scene.tools) tools.push_back(make_tool(spec, scene, thickness));
  return tools;
}

void tool_distances(const Tool& tool, const Placement& place, const Coordinates& x, int count, int* hint,
                    Distances& out) {
  switch (tool.shape) {
    case ToolShape::plane:
      return plane_distances(place, x, count, out);
    case ToolShape::sphere:
      return sphere_distances(place, tool.radius, x, count, out);
    case ToolShape::cylinder:
      return cylinder_distances(place, tool.radius, x, count, out);
    case ToolShape::ring:
      return ring_distances(place, tool.radius, tool.fillet_radius, x, count, out);
    case ToolShape::revolved:
      return revolved_distances(place, tool.profile, x, count, out);
    case ToolShape::triangles:
      return triangle_distances(*tool.surface, place, x, count, hint, out);
  }
}

std::filesystem::path tool_path(const std::string& path, const std::filesystem::path& scene_file) {
  return scene_file.parent_path() / path;  // an absolute path stays as it is
}

}  // namespace weaveform
