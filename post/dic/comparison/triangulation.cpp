#include "post/dic/comparison/triangulation.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"

namespace weaveform::dic {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;

using Edge = std::pair<int, int>;
using Segment = std::array<Edge, 2>;

// Chains of edges crossed one after the other: open chains from one of their ends, then closed ones.
std::vector<std::vector<Edge>> chains_of(const std::vector<Segment>& segments) {
  std::map<Edge, std::vector<std::size_t>> at;
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (const Edge& edge : segments[s]) at[edge].push_back(s);
  std::vector<bool> used(segments.size(), false);
  std::vector<std::vector<Edge>> chains;
  const auto walk = [&](const Edge& from, std::size_t segment) {
    std::vector<Edge> chain = {from};
    for (bool further = true; further;) {
      used[segment] = true;
      const Edge to = segments[segment][segments[segment][0] == chain.back() ? 1 : 0];
      chain.push_back(to);
      further = false;
      for (const std::size_t next : at[to])
        if (!used[next]) {
          segment = next;
          further = true;
          break;
        }
    }
    chains.push_back(std::move(chain));
  };
  for (const auto& [edge, here] : at)
    if (here.size() == 1 && !used[here.front()]) walk(edge, here.front());
  for (std::size_t s = 0; s < segments.size(); ++s)
    if (!used[s]) walk(segments[s][0], s);
  return chains;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate(const std::vector<Vec2>& points, double longest) {
  std::vector<std::pair<Kernel::Point_2, int>> input;
  for (std::size_t i = 0; i < points.size(); ++i)
    input.emplace_back(Kernel::Point_2(points[i][0], points[i][1]), static_cast<int>(i));
  const Delaunay delaunay(input.begin(), input.end());
  std::vector<std::array<int, 3>> triangles;
  for (auto face = delaunay.finite_faces_begin(); face != delaunay.finite_faces_end(); ++face) {
    std::array<int, 3> corner{};
    for (int k = 0; k < 3; ++k) corner[static_cast<std::size_t>(k)] = face->vertex(k)->info();
    bool small = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 &a = points[corner[k]], &b = points[corner[(k + 1) % 3]];
      small = small && std::hypot(a[0] - b[0], a[1] - b[1]) <= longest;
    }
    if (small) triangles.push_back(corner);
  }
  return triangles;
}

std::vector<Isoline> isolines(const std::vector<Vec2>& points, const std::vector<std::array<int, 3>>& triangles,
                              const std::vector<double>& value_deg, double step) {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const double value : value_deg) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  std::vector<Isoline> lines;
  if (!(least <= greatest)) return lines;
  const double first = std::ceil(least / step), last = std::floor(greatest / step);
  if (!(last - first < 1000.0))
    throw InputError(
        fmt::format("contour_step of [comparison]: {} deg gives more than 1000 isolines; choose a greater "
                    "step",
                    step));
  for (double multiple = first; multiple <= last; multiple += 1.0) {
    if (multiple == 0.0) continue;
    const double level = multiple * step;
    std::vector<Segment> segments;
    for (const auto& corner : triangles) {
      Segment segment;
      std::size_t crossed = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = corner[k], b = corner[(k + 1) % 3];
        // A corner at the level counts as above it, so that no line ends in a corner.
        const bool finite = std::isfinite(value_deg[a]) && std::isfinite(value_deg[b]);
        if (finite && (value_deg[a] >= level) != (value_deg[b] >= level) && crossed < 2)
          segment[crossed++] = {std::min(a, b), std::max(a, b)};
      }
      if (crossed == 2) segments.push_back(segment);
    }
    for (const auto& chain : chains_of(segments)) {
      Isoline line{level, {}};
      for (const auto& [a, b] : chain) {
        const double share = (level - value_deg[a]) / (value_deg[b] - value_deg[a]);
        line.point.push_back({points[a][0] + share * (points[b][0] - points[a][0]),
                              points[a][1] + share * (points[b][1] - points[a][1]), 0.0});
      }
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace weaveform::dic
