#include "mesher/automatic/bends.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/vector/angle.hpp"
#include "mesher/automatic/facets.hpp"

namespace weaveform {
namespace {

constexpr double left_out = 0.1;                           // of all turning, what is tighter than the radius counted
constexpr double least_deficit = 0.25 * std::numbers::pi;  // rad; of a part that is doubly curved, half a box corner
constexpr double on_the_axis = 1e-6;                       // of an arc's radius

void keep_tighter(ToolBend& kept, double radius, const std::string& tool, double along_yarns = 0.0) {
  if (radius < kept.radius) kept = {radius, tool, along_yarns};
}

// The radius beyond which all turning but the share `left_out` lies; infinite when nothing turns.
double radius_of_turning(std::vector<std::pair<double, double>> radius_and_turning) {
  std::sort(radius_and_turning.begin(), radius_and_turning.end());
  double all = 0.0;
  for (const auto& [radius, turning] : radius_and_turning) all += turning;
  double sum = 0.0;
  for (const auto& [radius, turning] : radius_and_turning) {
    sum += turning;
    if (sum >= left_out * all && sum > 0.0) return radius;
  }
  return std::numeric_limits<double>::infinity();
}

// mm; sqrt(2) times the narrower standard deviation in the plane of what is weighted.
double half_width(const std::vector<FacetVertex>& vertex) {
  double weight = 0.0;
  Vec2 mean = {0.0, 0.0};
  for (const FacetVertex& v : vertex) {
    weight += v.deficit;
    for (std::size_t c = 0; c < 2; ++c) mean[c] += v.deficit * v.at[c];
  }
  mean = scaled(mean, 1.0 / weight);
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (const FacetVertex& v : vertex) {
    const double x = v.at[0] - mean[0], y = v.at[1] - mean[1];
    xx += v.deficit * x * x / weight;
    xy += v.deficit * x * y / weight;
    yy += v.deficit * y * y / weight;
  }
  const double least = 0.5 * (xx + yy) - std::hypot(0.5 * (xx - yy), xy);  // the smaller principal value
  return std::sqrt(2.0 * std::max(least, 0.0));
}

class Looker {
public:
  Looker(const Scene& scene, double reach, ToolBends& bends) : scene_(scene), reach_(reach), bends_(bends) {}

  void look(const Tool& tool) {
    switch (tool.shape) {
      case ToolShape::plane:
        return;
      case ToolShape::sphere:
        add_edge(tool, tool.radius);
        return keep_tighter(bends_.form, tool.radius + tool.offset, tool.name);
      case ToolShape::cylinder:
        return add_edge(tool, tool.radius);
      case ToolShape::ring:
        if (tool.fillet_radius > 0.0) add_edge(tool, tool.fillet_radius);
        return;
      case ToolShape::revolved:
        return look_at_profile(tool);
      case ToolShape::triangles:
        return look_at_facets(tool);
    }
  }

private:
  [[nodiscard]] bool is_draped_over(const Tool& tool) const { return scene_.drape && scene_.drape->tool == tool.name; }
  void add_edge(const Tool& tool, double radius, double along_yarns = 0.0) {
    keep_tighter(bends_.edge, radius + tool.offset, tool.name, along_yarns);
    if (is_draped_over(tool)) keep_tighter(bends_.drape, radius + tool.offset, tool.name);
  }
  void add_hollow(const Tool& tool, double radius) {
    if (is_draped_over(tool)) keep_tighter(bends_.drape, std::max(radius - tool.offset, 0.0), tool.name);
  }

  // mm; of a part that a bulging arc forms: a dome's own radius where it ends on the axis, else that of the ring it is;
  // infinite where it faces the axis, as the fillet of an opening, which is a saddle.
  static double form_of(const ProfilePiece& arc) {
    if (std::min(arc.start[0], arc.end[0]) <= on_the_axis * arc.radius) return arc.radius;
    const bool outward = arc.start_normal[0] + arc.end_normal[0] > 0.0;
    return outward ? std::max(arc.start[0], arc.end[0]) : std::numeric_limits<double>::infinity();
  }

  void look_at_profile(const Tool& tool) {
    for (const ProfilePiece& piece : tool.profile.piece) {
      if (piece.radius < 0.0) add_hollow(tool, -piece.radius);
      if (piece.radius > 0.0) {
        add_edge(tool, piece.radius);
        keep_tighter(bends_.form, form_of(piece) + tool.offset, tool.name);
      }
    }
  }

  [[nodiscard]] bool in_reach(const Tool& tool, const Vec3& local) const {
    const Vec3 x = minus(plus(local, tool.start.origin), scene_.blank.position);
    return std::hypot(x[0], x[1]) <= reach_;
  }

  [[nodiscard]] bool runs_along_yarns(const Vec3& along) const {
    const double from_warp =
        std::atan2(along[1], along[0]) * degrees_per_radian - scene_.blank.orientation - scene_.blank.yarn_angle;
    return std::hypot(along[0], along[1]) > std::cos(nearly_along_deg / degrees_per_radian) &&
           std::abs(std::remainder(from_warp, 90.0)) < nearly_along_deg;
  }

  void look_at_facets(const Tool& tool) {
    const Facets facets = facets_of(*tool.surface);
    std::vector<std::pair<double, double>> bulging, hollow;  // radius (mm), turning (mm)
    double all = 0.0, along = 0.0;                           // mm; of what bulges
    for (const FacetEdge& edge : facets.edge) {
      if (!in_reach(tool, edge.at) || edge.turn == 0.0) continue;
      if (std::abs(edge.turn) * degrees_per_radian > sharp_turn_deg) continue;
      const double turn = std::abs(edge.turn);
      (edge.turn > 0.0 ? bulging : hollow).emplace_back(edge.width / turn, turn * edge.length);
      if (edge.turn < 0.0) continue;
      all += turn * edge.length;
      if (runs_along_yarns(edge.along)) along += turn * edge.length;
    }
    add_edge(tool, radius_of_turning(std::move(bulging)), all > 0.0 ? along / all : 0.0);
    add_hollow(tool, radius_of_turning(std::move(hollow)));
    std::vector<FacetVertex> convex;
    double deficit = 0.0;
    for (const FacetVertex& vertex : facets.vertex)
      if (vertex.turn_length > 0.0 && in_reach(tool, vertex.at)) {
        convex.push_back(vertex);
        deficit += vertex.deficit;
      }
    if (deficit > least_deficit) keep_tighter(bends_.form, half_width(convex) + tool.offset, tool.name);
  }

  const Scene& scene_;
  double reach_;  // mm
  ToolBends& bends_;
};

}  // namespace

ToolBends tool_bends(const Scene& scene, const std::vector<Tool>& tools, double reach) {
  ToolBends bends;
  Looker looker(scene, reach, bends);
  for (const Tool& tool : tools) looker.look(tool);
  return bends;
}

}  // namespace weaveform
