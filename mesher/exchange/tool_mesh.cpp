#include "mesher/exchange/tool_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/vector/vector.hpp"

namespace weaveform::foreign {

namespace {

using Corner = Vec2;  // (r, z)

// mm; beyond it no node gets, wherever the tool goes.
double reach_of(const Gathered& model, const ToolMotion& motion) {
  double farthest = 0.0;
  for (const auto& x : model.mesh.nodes.position) farthest = std::max(farthest, distance(x, motion.tool.start.origin));
  return 1.2 * (farthest + std::abs(motion.spec->travel)) + motion.tool.radius + motion.tool.fillet_radius;
}

// Its points, the first left out. Long lines are cut so that shells stay comparable to the fabric's cells.
void add_line(const Corner& to, double longest, std::vector<Corner>& outline) {
  const Corner from = outline.back();
  const int parts = std::max(1, static_cast<int>(std::ceil(distance(to, from) / longest)));
  for (int k = 1; k <= parts; ++k) {
    const double part = static_cast<double>(k) / parts;
    outline.push_back({from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])});
  }
}

double greatest_turn(double radius) {
  return 2.0 * std::acos(std::max(0.7, 1.0 - 0.5 * tool_sagitta / std::max(radius, 1e-9)));
}

// The shorter way from the last point about `centre`.
void add_arc(const Corner& centre, const Corner& to, std::vector<Corner>& outline) {
  const Corner from = outline.back();
  const double radius = distance(to, centre);
  const double start = std::atan2(from[1] - centre[1], from[0] - centre[0]);
  const double turn = std::remainder(std::atan2(to[1] - centre[1], to[0] - centre[0]) - start, 2.0 * std::numbers::pi);
  const int parts = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / greatest_turn(radius))));
  for (int k = 1; k < parts; ++k) {
    const double angle = start + turn * k / parts;
    outline.push_back({centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
  }
  outline.push_back(to);
}

Corner beyond(const Corner& from, const Corner& to, double reach) {
  const double length = distance(to, from);
  Corner end = {to[0] + reach * (to[0] - from[0]) / length, to[1] + reach * (to[1] - from[1]) / length};
  if (end[0] < 0.0) {  // not across the axis
    const double part = to[0] / (to[0] - end[0]);
    end = {0.0, to[1] + part * (end[1] - to[1])};
  }
  return end;
}

std::vector<Corner> outline_of_profile(const Profile& profile, double reach, double longest) {
  const auto& first = profile.piece.front();
  const auto& last = profile.piece.back();
  std::vector<Corner> outline = {first.start};
  if (first.endless[0]) {
    outline = {beyond(first.end, first.start, reach)};
    add_line(first.start, longest, outline);
  }
  for (const auto& piece : profile.piece)
    piece.radius == 0.0 ? add_line(piece.end, longest, outline) : add_arc(piece.centre, piece.end, outline);
  if (last.endless[1]) add_line(beyond(last.start, last.end, reach), longest, outline);
  return outline;
}

// In the half-plane (r, z), the material on the left of the way (mesher/tools/distance.hpp has the shapes).
std::vector<Corner> outline_of(const Tool& tool, double reach, double longest) {
  const double r = tool.radius, f = tool.fillet_radius;
  std::vector<Corner> outline;
  switch (tool.shape) {
    case ToolShape::plane:
      outline = {{reach, 0.0}};
      add_line({0.0, 0.0}, longest, outline);
      break;
    case ToolShape::sphere:
      outline = {{0.0, -r}};
      add_arc({0.0, 0.0}, {r, 0.0}, outline);
      add_line({r, reach}, longest, outline);
      break;
    case ToolShape::cylinder:
      outline = {{r, -reach}};
      add_line({r, reach}, longest, outline);
      break;
    case ToolShape::ring:
      outline = {{r + f + reach, 0.0}};
      add_line({r + f, 0.0}, longest, outline);
      if (f > 0.0) add_arc({r + f, -f}, {r, -f}, outline);
      add_line({r, -f - reach}, longest, outline);
      break;
    case ToolShape::revolved:
      outline = outline_of_profile(tool.profile, reach, longest);
      break;
    case ToolShape::triangles:
      break;
  }
  return outline;
}

// The greatest radius at which the surface is not flat across the axis.
double curved_radius(const std::vector<Corner>& outline) {
  double greatest = 0.0;
  for (std::size_t k = 1; k < outline.size(); ++k)
    if (std::abs(outline[k][1] - outline[k - 1][1]) > 1e-9)
      greatest = std::max({greatest, outline[k][0], outline[k - 1][0]});
  return greatest;
}

// Unit, two of them, that make a right-handed frame with the axis.
std::array<Vec3, 2> across(const Vec3& axis) {
  const std::size_t least = std::abs(axis[0]) < 0.6 ? 0 : (std::abs(axis[1]) < 0.6 ? 1 : 2);
  Vec3 start = {0.0, 0.0, 0.0};
  start[least] = 1.0;
  const Vec3 first = unit(cross(axis, start));
  return {first, cross(axis, first)};
}

ToolMesh revolve(const std::vector<Corner>& outline, const Placement& place) {
  const int around =
      std::clamp(static_cast<int>(std::ceil(2.0 * std::numbers::pi / greatest_turn(curved_radius(outline)))), 24, 720);
  const auto [e1, e2] = across(place.axis);
  ToolMesh mesh;
  std::vector<int> first;  // node of every ring; a ring on the axis is one node
  for (const auto& [r, z] : outline) {
    first.push_back(static_cast<int>(mesh.node.size()));
    const bool on_axis = r < 1e-9;
    for (int k = 0; k < (on_axis ? 1 : around); ++k) {
      const double angle = 2.0 * std::numbers::pi * k / around;
      Vec3 x{};
      for (std::size_t c = 0; c < 3; ++c)
        x[c] = place.origin[c] + z * place.axis[c] +
               (on_axis ? 0.0 : r * (std::cos(angle) * e1[c] + std::sin(angle) * e2[c]));
      mesh.node.push_back(x);
    }
  }
  for (std::size_t ring = 0; ring + 1 < outline.size(); ++ring) {
    const bool from_axis = outline[ring][0] < 1e-9, to_axis = outline[ring + 1][0] < 1e-9;
    if (from_axis && to_axis) continue;
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around, a = first[ring], b = first[ring + 1];
      if (from_axis)
        mesh.face.push_back({a, b + next, b + k, -1});
      else if (to_axis)
        mesh.face.push_back({a + k, a + next, b, -1});
      else
        mesh.face.push_back({a + k, a + next, b + next, b + k});
    }
  }
  return mesh;
}

ToolMesh mesh_of_triangles(const TriangleSurface& surface, const Placement& place) {
  ToolMesh mesh;
  std::map<Vec3, int> at;
  for (int t = 0; t < surface.size(); ++t) {
    std::array<int, 4> face = {-1, -1, -1, -1};
    const auto corners = surface.corners(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [found, added] = at.emplace(corners[k], static_cast<int>(mesh.node.size()));
      if (added) {
        Vec3 x = corners[k];
        for (std::size_t c = 0; c < 3; ++c) x[c] += place.origin[c];
        mesh.node.push_back(x);
      }
      face[k] = found->second;
    }
    mesh.face.push_back(face);
  }
  return mesh;
}

}  // namespace

ToolMesh mesh_of_tool(const Gathered& model, const ToolMotion& motion) {
  const Tool& tool = motion.tool;
  if (tool.shape == ToolShape::triangles) return mesh_of_triangles(*tool.surface, tool.start);
  const double longest = 4.0 * std::max(model.mesh.spacing[0], model.mesh.spacing[1]);
  return revolve(outline_of(tool, reach_of(model, motion), longest), tool.start);
}

}  // namespace weaveform::foreign
