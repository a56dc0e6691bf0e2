#include "mesher/drape/start.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/vector/eigen_vector.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr double seed_tolerance = 0.1;  // of the smaller spacing; what digits a user copies from a drawing lose
constexpr double least_tangent = 0.1;   // sine of the angle between a warp direction and the normal

std::string place_text(const Vector3d& x) {
  // no "-0": it reads like a mistake
  const auto tidy = [](double a) { return std::abs(a) < 5e-7 ? 0.0 : a; };
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", tidy(x[0]), tidy(x[1]), tidy(x[2]));
}

[[noreturn]] void complain(const Scene& scene, const std::string& what) {
  throw InputError((scene.file.empty() ? "" : scene.file + ": ") + "[drape] " + what);
}

const Tool& named_tool(const Scene& scene, const std::vector<Tool>& tools) {
  std::vector<std::string> names;
  for (const Tool& tool : tools) {
    if (tool.name == scene.drape->tool) return tool;
    names.push_back(tool.name);
  }
  complain(scene, fmt::format("tool: there is no [tools.{}]{}", scene.drape->tool,
                              names.empty() ? "; add it" : did_you_mean(scene.drape->tool, names)));
}

// The given seed, moved the little that is missing to the middle plane of fabric in contact.
Vector3d given_seed(const Scene& scene, const DrapeStart& start, double spacing) {
  const Vector3d given = vector_of(*scene.drape->seed);
  Vector3d seed = given;
  int hint = 0;
  const bool found = project(*start.surface, seed, hint);
  const double off = (seed - given).norm();
  if (found && off <= start.offset + seed_tolerance * spacing) return seed;
  complain(scene,
           fmt::format("seed {} mm is {:.4g} mm off the surface of tool '{}'{}; the nearest point of it is {} mm",
                       place_text(given), off, scene.drape->tool, found ? "" : " (past its border)", place_text(seed)));
}

// Sphere tracing from far outside: every step is the distance to the tool, so it cannot pass through it.
Vector3d projected_seed(const Scene& scene, const DrapeStart& start, const Tool& tool) {
  const DrapeSpec& drape = *scene.drape;
  const Vector3d anchor = flat_point(scene.blank, drape.anchor);
  const Vector3d way = vector_of(drape.projection).normalized();
  const double extent = std::hypot(scene.blank.size[0], scene.blank.size[1]) +
                        (anchor - vector_of(tool.start.origin)).norm() + tool.radius;
  const double far = 10.0 * extent;
  int hint = 0;
  double t = -far;
  const std::string from = fmt::format("the blank's point {} mm, seen along {}", place_text(anchor), place_text(way));
  if (start.surface->at(anchor + t * way, hint).value <= 0.0)
    complain(scene, fmt::format("{}: far before tool '{}' it is inside it already; project from the tool's open side "
                                "(drape.projection), or turn its normals outward if it comes from a file",
                                from, tool.name));
  for (int n = 0; n < 100000 && t < far; ++n) {
    Vector3d x = anchor + t * way;
    const SurfacePoint p = start.surface->at(x, hint);
    if (std::abs(p.value) < 1e-9 * extent) {
      if (p.beyond || !project(*start.surface, x, hint)) break;
      return x;
    }
    t += std::max(p.value, 1e-10 * extent);
  }
  complain(scene, fmt::format("the blank misses tool '{}': {}, nothing of it is met; move blank or tool, or set "
                              "drape.anchor, drape.projection or drape.seed",
                              tool.name, from));
}

// The crossing nearest to the anchor.
std::array<int, 2> nearest_crossing(const Scene& scene, const Mesh& mesh) {
  const Vector3d anchor = flat_point(scene.blank, scene.drape->anchor);
  double least = INFINITY;
  std::array<int, 2> nearest = {0, 0};
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (mesh.nodes.crossing[n][0] < 0) continue;
    const double off = (vector_of(mesh.nodes.position[n]) - anchor).squaredNorm();
    if (off >= least) continue;
    least = off;
    nearest = mesh.nodes.crossing[n];
  }
  if (std::sqrt(least) > std::max(mesh.spacing[0], mesh.spacing[1]))
    complain(scene, fmt::format("anchor: no crossing of the blank lies near {} mm; put it inside the blank",
                                place_text(anchor)));
  return nearest;
}

// A curve through the seed, cut there into a part ahead and a part behind.
std::array<std::vector<Vector3d>, 2> cut_at_seed(const Scene& scene, const std::vector<std::vector<double>>& points,
                                                 const std::string& key, const Vector3d& seed, double tolerance) {
  std::vector<Vector3d> point;
  for (const auto& p : points) {
    if (p.size() != 3) complain(scene, key + ": a point is three numbers, [x, y, z]");
    point.emplace_back(p[0], p[1], p[2]);
  }
  if (point.size() < 2) complain(scene, key + ": a curve needs two points or more");
  double least = INFINITY;
  std::size_t piece = 0;
  for (std::size_t k = 0; k + 1 < point.size(); ++k) {
    const Vector3d along = point[k + 1] - point[k];
    const double square = along.squaredNorm();
    const double t = square > 0.0 ? std::clamp((seed - point[k]).dot(along) / square, 0.0, 1.0) : 0.0;
    const double off = (point[k] + t * along - seed).norm();
    if (off >= least) continue;
    least = off;
    piece = k;
  }
  if (least > tolerance)
    complain(scene, fmt::format("{} passes the seed {} mm at a distance of {:.4g} mm; it must go through it", key,
                                place_text(seed), least));
  const auto cut = [&](bool ahead) {
    std::vector<Vector3d> part(ahead ? point.begin() + static_cast<std::ptrdiff_t>(piece) + 1 : point.begin(),
                               ahead ? point.end() : point.begin() + static_cast<std::ptrdiff_t>(piece) + 1);
    if (!ahead) std::reverse(part.begin(), part.end());
    // a point on the seed itself gives no direction
    if (!part.empty() && (part.front() - seed).norm() <= tolerance) part.erase(part.begin());
    return part;
  };
  return {cut(true), cut(false)};
}

Vector3d warp_direction(const Scene& scene, const NetStart& net, const Vector3d& normal) {
  const DrapeSpec& drape = *scene.drape;
  const double angle = (scene.blank.yarn_angle + scene.blank.orientation) * std::numbers::pi / 180.0;
  Vector3d warp = drape.warp_direction ? vector_of(*drape.warp_direction).normalized()
                                       : Vector3d(std::cos(angle), std::sin(angle), 0.0);
  if (!net.curve[0][0].empty()) warp = (net.curve[0][0].front() - net.seed).normalized();
  if (warp.cross(normal).norm() < least_tangent)
    complain(scene, fmt::format("the warp direction {} is across the surface at the seed {} mm; set "
                                "drape.warp_direction to one along it",
                                place_text(warp), place_text(net.seed)));
  return warp;
}

}  // namespace

Vector3d flat_point(const BlankSpec& blank, const std::array<double, 2>& point) {
  const double angle = blank.orientation * std::numbers::pi / 180.0;
  const double c = std::cos(angle), s = std::sin(angle);
  return {blank.position[0] + c * point[0] - s * point[1], blank.position[1] + s * point[0] + c * point[1],
          blank.position[2]};
}

DrapeStart drape_start(const Scene& scene, const Mesh& mesh, const std::vector<Tool>& tools) {
  const DrapeSpec& drape = *scene.drape;
  DrapeStart start;
  const Tool& tool = named_tool(scene, tools);
  start.crossing = nearest_crossing(scene, mesh);
  start.offset = tool.offset;
  start.surface = std::make_unique<ToolSurface>(tool, tool.offset);
  const double spacing = std::min(mesh.spacing[0], mesh.spacing[1]);
  NetStart& net = start.net;
  net.spacing = mesh.spacing;
  net.seed = drape.seed ? given_seed(scene, start, spacing) : projected_seed(scene, start, tool);
  int hint = 0;
  const Vector3d outward = start.surface->normal(net.seed, hint);
  // The fabric's upper side stays up; where the tool stands upright, it is the outer one.
  net.normal = outward[2] < -1e-9 ? Vector3d(-outward) : outward;
  const double tolerance = start.offset + seed_tolerance * spacing;
  if (!drape.warp_curve.empty()) net.curve[0] = cut_at_seed(scene, drape.warp_curve, "warp_curve", net.seed, tolerance);
  if (!drape.weft_curve.empty()) net.curve[1] = cut_at_seed(scene, drape.weft_curve, "weft_curve", net.seed, tolerance);
  net.warp = warp_direction(scene, net, outward);
  return start;
}

}  // namespace weaveform
