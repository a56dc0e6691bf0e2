#include "post/forming/wrinkles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "post/forming/fabric_surface.hpp"
#include "post/forming/yarn_path.hpp"
#include "solver/bending/bending_energy.hpp"

namespace weaveform {
namespace {

// Curvature out of the fabric's plane of both yarns, from the bend's own nodes taken from `place`.
std::array<double, 2> out_of_plane(const Bend& bend, const std::vector<Vec3>& place) {
  const auto kappa = curvatures({bend}, place).front();
  return {kappa[1], kappa[3]};
}

// The bend's nodes renumbered 0..4, and their numbers in the mesh.
struct LocalBend {
  Bend bend;
  std::vector<int> node;
};

LocalBend local(const Bend& bend) {
  LocalBend result{bend, {bend.node}};
  result.bend.node = 0;
  const auto number = [&](int n) {
    if (n == bend.node) return 0;
    result.node.push_back(n);
    return static_cast<int>(result.node.size()) - 1;
  };
  for (auto& yarn : result.bend.yarn) {
    yarn.before = number(yarn.before);
    yarn.after = number(yarn.after);
  }
  return result;
}

// The curvatures that tools near a bend may give its yarn, and none.
struct Interval {
  double low = 0.0, high = 0.0;  // 1/mm
  void take(double curvature) {
    low = std::min(low, curvature);
    high = std::max(high, curvature);
  }
  // Signed as the curvature is against the fabric's normal.
  [[nodiscard]] double excess(double curvature) const {
    return std::max(curvature - high, 0.0) - std::max(low - curvature, 0.0);
  }
};

// Per family. `place` holds the bend's own nodes.
std::array<Interval, 2> tool_curvatures(const LocalBend& around, const std::vector<Vec3>& place,
                                        const std::vector<PlacedTool>& tools) {
  std::set<int> near;
  for (const Vec3& x : place) near.insert(nearest_tool(tools, vector_of(x)));
  std::array<Interval, 2> interval;
  for (const int t : near) {
    std::vector<Vec3> on_tool;
    for (const Vec3& at : place) {
      const Eigen::Vector3d x = vector_of(at);
      const Gap gap = gap_to(tools[t], x);
      const Eigen::Vector3d y = x - gap.gap * gap.normal;
      on_tool.push_back({y.x(), y.y(), y.z()});
    }
    const auto kt = out_of_plane(around.bend, on_tool);
    for (std::size_t f = 0; f < 2; ++f) interval[f].take(kt[f]);
  }
  return interval;
}

// Greatest difference of the gap to `tool` along a yarn, both ways from `node`, as far as `reach` (mm).
double relief_along(const Mesh& mesh, const YarnPath& path, int node, const std::vector<Vec3>& position,
                    const PlacedTool& tool, double reach) {
  const double here = gap_to(tool, vector_of(position[node])).gap;
  double greatest = 0.0;
  for (const bool onwards : {true, false}) {
    double way = 0.0;
    for (int n = node, steps = 0; steps == 0 || way < reach; ++steps) {
      const int element = onwards ? path.after[n] : path.before[n];
      if (element < 0) break;
      way += mesh.yarns.rest_length[element];
      if (steps > 0 && way > reach * (1.0 + 1e-9)) break;
      n = mesh.yarns.node[element][onwards ? 1 : 0];
      greatest = std::max(greatest, std::abs(gap_to(tool, vector_of(position[n])).gap - here));
    }
  }
  return greatest;
}

void sum_up(const Mesh& mesh, Wrinkles& wrinkles) {
  for (std::size_t n = 0; n < wrinkles.wrinkled.size(); ++n) {
    wrinkles.greatest_curvature = std::max(wrinkles.greatest_curvature, wrinkles.curvature[n]);
    if (wrinkles.wrinkled[n]) wrinkles.greatest_relief = std::max(wrinkles.greatest_relief, wrinkles.relief[n]);
  }
  wrinkles.area_share = area_share(mesh, wrinkles.wrinkled);
}

}  // namespace

std::vector<double> node_areas(const Mesh& mesh) {
  std::vector<double> area(mesh.node_count(), 0.0);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    for (int a = begin; a < end; ++a) area[mesh.cells.node[a]] += mesh.cells.area[c] / (end - begin);
  }
  return area;
}

double area_share(const Mesh& mesh, const std::vector<bool>& marked) {
  const std::vector<double> area = node_areas(mesh);
  double share = 0.0, whole = 0.0;
  for (std::size_t n = 0; n < area.size(); ++n) {
    whole += area[n];
    share += marked[n] ? area[n] : 0.0;
  }
  return whole > 0.0 ? share / whole : 0.0;
}

double WrinkleLimits::curvature(double thickness) const {
  return height * thickness * std::pow(2.0 * std::numbers::pi / (length * thickness), 2);
}

Wrinkles find_wrinkles(const Mesh& mesh, const std::vector<Vec3>& position, const std::vector<PlacedTool>& tools,
                       const WrinkleLimits& limits) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  const std::vector<double> none(nodes, 0.0);
  Wrinkles wrinkles{none, none, {none, none}, std::vector<bool>(nodes, false)};
  const std::array<YarnPath, 2> path = {yarn_path(mesh, Family::warp), yarn_path(mesh, Family::weft)};
  const double least_relief = limits.relief(mesh.thickness), least_curvature = limits.curvature(mesh.thickness);
  for (const Bend& bend : find_bends(mesh, std::vector<char>(nodes, 0))) {
    const int n = bend.node;
    const int nearest = nearest_tool(tools, vector_of(position[n]));
    if (nearest < 0) continue;
    const PlacedTool& tool = tools[nearest];
    const LocalBend around = local(bend);
    std::vector<Vec3> fabric;
    for (const int k : around.node) fabric.push_back(position[k]);
    const auto kf = out_of_plane(around.bend, fabric);
    const auto allowed = tool_curvatures(around, fabric, tools);
    for (std::size_t f = 0; f < 2; ++f) {
      if (bend.yarn[f].yarns == 0.0) continue;
      wrinkles.excess[f][n] = allowed[f].excess(kf[f]);
      const double curvature = std::abs(wrinkles.excess[f][n]);
      const double relief = relief_along(mesh, path[f], n, position, tool, 0.5 * limits.length * mesh.thickness);
      if (relief > least_relief && curvature > least_curvature) wrinkles.wrinkled[n] = true;
      if (relief * curvature < wrinkles.relief[n] * wrinkles.curvature[n]) continue;
      wrinkles.relief[n] = relief;
      wrinkles.curvature[n] = curvature;
    }
  }
  sum_up(mesh, wrinkles);
  return wrinkles;
}

}  // namespace weaveform
