#include "post/forming/meridian.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace weaveform {
namespace {

using Eigen::Vector3d;
using Edge = std::pair<int, int>;  // points, rising

// The cut as a graph: crossed edges of the surface, joined in twos by the triangles.
struct Cut {
  std::vector<FabricPoint> point;
  std::vector<std::vector<int>> next;  // one neighbour on the fabric's edge, two inside
};

// A point in the plane counts as beyond it, so that the cut through a row of nodes is that row and nothing is
// ambiguous.
Cut cut_by_plane(const FabricSurface& surface, const Vector3d& origin, const Vector3d& normal) {
  double extent = 0.0;
  std::vector<double> distance;
  for (const auto& p : surface.point) {
    extent = std::max(extent, (p.place - origin).norm());
    distance.push_back((p.place - origin).dot(normal));
  }
  for (double& d : distance)
    if (std::abs(d) < 1e-10 * extent) d = 0.0;
  Cut cut;
  std::map<Edge, int> at;
  const auto crossing = [&](int a, int b) {
    const Edge edge = std::minmax(a, b);
    const auto [found, is_new] = at.try_emplace(edge, static_cast<int>(cut.point.size()));
    if (is_new) {
      const double t = distance[edge.first] / (distance[edge.first] - distance[edge.second]);
      cut.point.push_back(between(surface.point[edge.first], surface.point[edge.second], t));
      cut.next.emplace_back();
    }
    return found->second;
  };
  for (const auto& corner : surface.triangle) {
    std::vector<int> end;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = corner[k], b = corner[(k + 1) % 3];
      if ((distance[a] >= 0.0) != (distance[b] >= 0.0)) end.push_back(crossing(a, b));
    }
    if (end.size() != 2) continue;
    cut.next[end[0]].push_back(end[1]);
    cut.next[end[1]].push_back(end[0]);
  }
  return cut;
}

// Walks on from `here`, having come from `before`, to the end of the chain.
std::vector<int> walk(const Cut& cut, int before, int here) {
  std::vector<int> chain;
  const int first = before;
  for (;;) {
    chain.push_back(here);
    int to = -1;
    for (const int n : cut.next[here])
      if (n != before) to = n;
    if (to < 0 || to == first || chain.size() > cut.point.size()) return chain;
    before = here;
    here = to;
  }
}

struct Start {
  int behind = -1, ahead = -1;  // of the axis; behind -1: the chain begins on this side of it
  double distance = 1e300;      // mm; from the axis
};

// The step of the cut that passes the axis; when none does, the end of a chain that is nearest to it.
Start find_start(const Cut& cut, const std::vector<double>& along) {
  Start start;
  for (int a = 0; a < static_cast<int>(cut.point.size()); ++a)
    for (const int b : cut.next[a])
      if (along[a] < 0.0 && along[b] >= 0.0) return {a, b, 0.0};
  for (int a = 0; a < static_cast<int>(cut.point.size()); ++a)
    if (cut.next[a].size() == 1 && along[a] >= 0.0 && along[a] < start.distance) start = {-1, a, along[a]};
  return start;
}

}  // namespace

std::vector<MeridianPoint> meridian(const FabricSurface& surface, const PartAxis& axis, double azimuth) {
  const Vector3d outwards = std::cos(azimuth) * axis.warp + std::sin(azimuth) * axis.weft;
  const Cut cut = cut_by_plane(surface, axis.origin, axis.up.cross(outwards));
  std::vector<double> along;
  for (const auto& p : cut.point) along.push_back((p.place - axis.origin).dot(outwards));
  const Start start = find_start(cut, along);
  if (start.ahead < 0) return {};

  std::vector<FabricPoint> passed;
  if (start.behind >= 0) {
    const double a = along[start.behind], b = along[start.ahead];
    passed.push_back(between(cut.point[start.behind], cut.point[start.ahead], a / (a - b)));
  }
  for (const int n : walk(cut, start.behind, start.ahead)) passed.push_back(cut.point[n]);

  std::vector<MeridianPoint> points;
  for (const auto& p : passed) {
    const double step = points.empty() ? 0.0 : (p.place - points.back().place).norm();
    if (!points.empty() && step < 1e-9) continue;
    const double arc = points.empty() ? 0.0 : points.back().arc + step;
    points.push_back({arc, p.angle, axis.height(p.place), axis.radius(p.place), p.place});
  }
  return points;
}

}  // namespace weaveform
