#include "mesher/automatic/facets.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace weaveform {
namespace {

struct Side {  // of a triangle, as an edge sees it
  Vec3 normal = {0.0, 0.0, 0.0};
  Vec3 opposite = {0.0, 0.0, 0.0};  // mm; the corner that is not on the edge
};

struct Shared {
  Vec3 begin, end;  // mm
  std::vector<Side> side;
};

double cotangent_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 u = minus(a, corner), v = minus(b, corner);
  return dot(u, v) / std::max(length(cross(u, v)), 1e-300);
}

double angle_at(const Vec3& corner, const Vec3& a, const Vec3& b) {
  const Vec3 u = minus(a, corner), v = minus(b, corner);
  return std::atan2(length(cross(u, v)), dot(u, v));
}

// The circumcentres of two triangles are l (cot a + cot b)/2 apart, a and b opposite to the edge of length l. Between a third
// of both heights (centres of mass) and half of them (strips of a cylinder): of oblique slivers they lie anywhere.
FacetEdge edge_of(const Shared& shared) {
  const Side &one = shared.side[0], &other = shared.side[1];
  const Vec3 along = minus(shared.end, shared.begin);
  FacetEdge edge{.at = scaled(plus(shared.begin, shared.end), 0.5), .length = length(along)};
  edge.along = scaled(along, 1.0 / edge.length);
  const double turn = std::atan2(length(cross(one.normal, other.normal)), dot(one.normal, other.normal));
  const bool bulges = dot(minus(other.opposite, shared.begin), one.normal) < 0.0;
  edge.turn = bulges ? turn : -turn;
  double centres = 0.0, heights = 0.0;
  for (const Side& side : shared.side) {
    centres += 0.5 * edge.length * cotangent_at(side.opposite, shared.begin, shared.end);
    heights += length(cross(along, minus(side.opposite, shared.begin))) / edge.length;
  }
  edge.width = std::clamp(centres, heights / 3.0, heights / 2.0);
  return edge;
}

}  // namespace

Facets facets_of(const TriangleSurface& surface) {
  std::map<Vec3, int> number;
  std::map<std::pair<int, int>, Shared> shared;
  Facets facets;
  for (int t = 0; t < surface.size(); ++t) {
    const auto corner = surface.corners(t);
    const Vec3 normal = surface.face_normal(t);
    std::array<int, 3> node{};
    for (int c = 0; c < 3; ++c) {
      node[c] = number.emplace(corner[c], static_cast<int>(number.size())).first->second;
      if (node[c] == static_cast<int>(facets.vertex.size()))
        facets.vertex.push_back({corner[c], 2.0 * std::numbers::pi, 0.0});
      facets.vertex[node[c]].deficit -= angle_at(corner[c], corner[(c + 1) % 3], corner[(c + 2) % 3]);
    }
    for (int c = 0; c < 3; ++c) {
      const int a = node[c], b = node[(c + 1) % 3];
      Shared& edge = shared[std::minmax(a, b)];
      edge.begin = corner[c];
      edge.end = corner[(c + 1) % 3];
      edge.side.push_back({normal, corner[(c + 2) % 3]});
    }
  }
  std::vector<char> inside(facets.vertex.size(), 1);
  for (const auto& [nodes, edge] : shared) {
    if (edge.side.size() != 2) {
      inside[nodes.first] = inside[nodes.second] = 0;
      continue;
    }
    const FacetEdge& made = facets.edge.emplace_back(edge_of(edge));
    for (const int node : {nodes.first, nodes.second}) facets.vertex[node].turn_length += made.turn * made.length;
  }
  std::size_t kept = 0;
  for (std::size_t n = 0; n < facets.vertex.size(); ++n)
    if (inside[n] != 0) facets.vertex[kept++] = facets.vertex[n];
  facets.vertex.resize(kept);
  return facets;
}

}  // namespace weaveform
