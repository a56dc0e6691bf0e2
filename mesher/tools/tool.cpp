#include "mesher/tools/tool.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/files/digest.hpp"
#include "core/vector/vector.hpp"
#include "mesher/tools/surface_file.hpp"
#include "mesher/tools/triangle_report.hpp"

namespace weaveform {
namespace {

// The way the tool faces.
Vec3 default_direction(const Tool& tool) {
  switch (tool.shape) {
    case ToolShape::plane:
    case ToolShape::ring:
      return tool.start.axis;
    case ToolShape::sphere:
      return scaled(unit(tool.start.axis), -1.0);
    default:
      return {0.0, 0.0, -1.0};
  }
}

// Touching the flat blank at its centre, from the side that its axis says.
Vec3 touching_position(const Tool& tool, const BlankSpec& blank) {
  Vec3 position = blank.position;
  const double up = tool.start.axis[2] > 0.0 ? 1.0 : -1.0;
  position[2] += tool.shape == ToolShape::sphere ? up * (tool.radius + tool.offset) : -up * tool.offset;
  return position;
}

// A blank and its tool are of one size; factors between units are far from that.
void check_proportion(const TriangleList& list, const ToolSpec& spec, const Scene& scene, const std::string& where) {
  constexpr double farthest = 50.0;
  double extent = 0.0;
  for (int c = 0; c < 3; ++c) {
    const auto [least, greatest] = std::minmax_element(list.point.begin(), list.point.end(),
                                                       [c](const auto& a, const auto& b) { return a[c] < b[c]; });
    extent = std::max(extent, (*greatest)[c] - (*least)[c]);
  }
  const double blank = std::max(scene.blank.size[0], scene.blank.size[1]);
  if (extent * farthest < blank)
    throw InputError(
        fmt::format("{} {}: the surface is {:.3g} mm across and the blank {:.4g} mm: is the file in metres? Set unit = "
                    "\"m\" (or \"cm\", "
                    "\"inch\"; \"mm\" if it is right)",
                    where, spec.file, extent, blank));
  if (extent > farthest * blank)
    throw InputError(
        fmt::format("{} {}: the surface is {:.4g} mm across and the blank {:.4g} mm: is it in micrometres, or "
                    "the blank's size in another unit? Set unit = \"mm\" if it is right",
                    where, spec.file, extent, blank));
}

// A point, seen from the tool, on the side where the fabric is: the flat blank's centre, or far back along the way in
// which a blank that starts draped over this tool is projected on it.
Vec3 side_of_the_blank(const ToolSpec& spec, const Scene& scene) {
  Vec3 point = scene.blank.position;
  for (int c = 0; c < 3; ++c) point[c] -= spec.position ? (*spec.position)[c] : 0.0;
  if (!scene.drape || scene.drape->tool != spec.name) return point;
  constexpr double far = 1e6;  // mm
  const Vec3 way = unit(scene.drape->projection);
  for (int c = 0; c < 3; ++c) point[c] -= far * way[c];
  return point;
}

FileSurface surface_of(const ToolSpec& spec, const Scene& scene, double cell_edge, const std::string& where) {
  const auto file = tool_path(spec.file, scene.file);
  const bool sense_is_ours = surface_kind(file) != SurfaceKind::stl;
  const double tolerance = spec.chord_tolerance.value_or(chord_per_cell * cell_edge);
  FileSurface surface = read_surface(file, {millimetres_in(spec.unit), tolerance, spec.name});
  TriangleList& list = surface.list;
  if (!spec.unit) check_proportion(list, spec, scene, where);
  if (sense_is_ours) {
    list = turned_alike(list, side_of_the_blank(spec, scene));
  }
  if (spec.flip) list = turned_over(std::move(list));
  if (!sense_is_ours && turned_inward(list) && !spec.flip)
    throw InputError(
        fmt::format("{} {}: the closed surface has its normals inward, so that its outside would be solid; set "
                    "flip = true, or write it again with its triangles counter-clockwise seen from outside",
                    where, file.string()));
  return surface;
}

Tool ready_tool(const ToolSpec& spec, const Scene& scene, double thickness, double cell_edge) {
  const std::string where = (scene.file.empty() ? "" : scene.file + ": ") + "[tools." + spec.name + "]";
  Tool tool;
  tool.name = spec.name;
  tool.shape = spec.shape;
  tool.start.axis = unit(spec.axis);
  tool.offset = offset_of(spec, thickness);
  tool.friction = spec.friction;
  tool.fillet_radius = spec.fillet_radius;
  tool.radius = tool.shape == ToolShape::ring ? spec.opening_radius.value_or(0.0) : spec.radius.value_or(0.0);
  if (tool.shape == ToolShape::revolved) tool.profile = make_profile(spec.profile, where + " profile");
  if (tool.shape == ToolShape::triangles) {
    tool.start.axis = {0.0, 0.0, 1.0};
    FileSurface surface = surface_of(spec, scene, cell_edge, where);
    const std::string file = tool_path(spec.file, scene.file).string();
    tool.surface = std::make_shared<TriangleSurface>(surface.list, where + " " + file);
    Digest digest;
    digest.add(surface.list.point);
    digest.add(surface.list.triangle);
    tool.surface_digest = digest.hex();
    for (const std::string& word : surface.words) tool.notes.push_back(where + " " + file + ": " + word);
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
    const Vec3 local = {x[0][n] - place.origin[0], x[1][n] - place.origin[1], x[2][n] - place.origin[2]};
    const SurfaceDistance found = surface.distance(local, hint == nullptr ? 0 : hint[n]);
    if (hint != nullptr) hint[n] = found.triangle;
    out.distance[n] = found.distance;
    for (int c = 0; c < 3; ++c) out.normal[c][n] = found.normal[c];
  }
}

}  // namespace

double cell_edge_of(const Mesh& mesh) {
  const double edge = std::min(mesh.spacing[0], mesh.spacing[1]);
  return edge > 0.0 ? edge : usual_cell_edge;
}

std::vector<Tool> make_tools(const Scene& scene, const Mesh& mesh) {
  return make_tools(scene, mesh.thickness, cell_edge_of(mesh));
}

std::vector<Tool> make_tools(const Scene& scene, double thickness, double cell_edge) {
  std::vector<Tool> tools;
  for (const auto& spec : scene.tools) tools.push_back(ready_tool(spec, scene, thickness, cell_edge));
  return tools;
}

Tool make_tool(const ToolSpec& spec, const Scene& scene, const Mesh& mesh) {
  return ready_tool(spec, scene, mesh.thickness, cell_edge_of(mesh));
}

Tool make_tool(const ToolSpec& spec, const Scene& scene, double thickness, double cell_edge) {
  return ready_tool(spec, scene, thickness, cell_edge);
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
