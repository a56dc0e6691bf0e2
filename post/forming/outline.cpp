#include "post/forming/outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "post/forming/fabric_surface.hpp"

namespace weaveform {
namespace {

using Eigen::Vector2d;

double length_of(const std::vector<int>& loop, const std::vector<Vec3>& position) {
  double length = 0.0;
  for (std::size_t k = 0; k < loop.size(); ++k)
    length += (vector_of(position[loop[(k + 1) % loop.size()]]) - vector_of(position[loop[k]])).norm();
  return length;
}

// Sides of cells whose opposite no cell has: the node after each node. Two loops may touch in a node.
std::map<int, std::vector<int>> outline_sides(const MeshCells& cells) {
  std::set<std::pair<int, int>> side;
  for (int c = 0; c < cells.size(); ++c)
    for (int a = cells.offset[c]; a < cells.offset[c + 1]; ++a)
      side.insert({cells.node[a], cells.node[a + 1 < cells.offset[c + 1] ? a + 1 : cells.offset[c]]});
  std::map<int, std::vector<int>> after;
  for (const auto& [a, b] : side)
    if (side.count({b, a}) == 0) after[a].push_back(b);
  return after;
}

}  // namespace

std::vector<int> outline_nodes(const Mesh& mesh) {
  std::map<int, std::vector<int>> after = outline_sides(mesh.cells);
  std::vector<int> longest;
  double greatest = -1.0;
  while (!after.empty()) {
    std::vector<int> loop;
    for (auto here = after.begin(); here != after.end();) {
      loop.push_back(here->first);
      const int next = here->second.back();
      here->second.pop_back();
      if (here->second.empty()) after.erase(here);
      here = after.find(next);
    }
    const double length = length_of(loop, flat_positions(mesh));
    if (length > greatest) {
      greatest = length;
      longest = loop;
    }
  }
  return longest;
}

std::optional<double> outline_radius(const std::vector<int>& nodes, const std::vector<Vec3>& position,
                                     const PartAxis& axis, double azimuth) {
  const Vector2d ray(std::cos(azimuth), std::sin(azimuth)), beside(-ray.y(), ray.x());
  std::optional<double> farthest;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Vector2d a = axis.across(vector_of(position[nodes[k]]));
    const Vector2d b = axis.across(vector_of(position[nodes[(k + 1) % nodes.size()]]));
    const double fa = a.dot(beside), fb = b.dot(beside);
    if ((fa >= 0.0) == (fb >= 0.0)) continue;
    const double radius = (a + fa / (fa - fb) * (b - a)).dot(ray);
    if (radius >= 0.0) farthest = std::max(farthest.value_or(0.0), radius);
  }
  return farthest;
}

std::optional<double> DrawIn::at(double azimuth) const {
  for (const auto& r : row)
    if (std::abs(r.azimuth - azimuth) < std::numbers::pi / 360.0) return r.draw_in();
  return {};
}

DrawIn draw_in(const std::vector<int>& outline, const std::vector<Vec3>& flat, const std::vector<Vec3>& position,
               const PartAxis& axis) {
  DrawIn result;
  for (int degree = 0; degree < 360; ++degree) {
    const double azimuth = degree * std::numbers::pi / 180.0;
    const auto before = outline_radius(outline, flat, axis, azimuth);
    const auto after = outline_radius(outline, position, axis, azimuth);
    if (before && after) result.row.push_back({azimuth, *before, *after});
  }
  if (result.row.empty()) return result;
  result.least = result.greatest = result.row.front().draw_in();
  for (const auto& r : result.row) {
    result.least = std::min(result.least, r.draw_in());
    // of directions that are equal but for rounding (a symmetric part) the first
    if (r.draw_in() <= result.greatest + 1e-6) continue;
    result.greatest = r.draw_in();
    result.greatest_at = r.azimuth;
  }
  for (const auto& r : result.row) result.mean += r.draw_in() / static_cast<double>(result.row.size());
  return result;
}

}  // namespace weaveform
