// Nets on surfaces with a formula, and what to measure on them.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/drape/net.hpp"

namespace weaveform::test {

using Eigen::Vector3d;

inline ImplicitSurface sphere_surface(double radius) {
  return ImplicitSurface([radius](const Vector3d& x) {
    return SurfacePoint{x.norm() - radius, x.normalized(), false};
  });
}

// z = h(x, y)
template <class Height, class Slope>
ImplicitSurface height_field(Height height, Slope slope) {
  return ImplicitSurface([height, slope](const Vector3d& x) {
    const Eigen::Vector2d d = slope(x[0], x[1]);
    return SurfacePoint{x[2] - height(x[0], x[1]), Vector3d(-d[0], -d[1], 1.0), false};
  });
}

inline NetBox square_box(int cells) {
  return {{-cells, -cells}, {2 * cells + 1, 2 * cells + 1}};
}

inline DrapedNet drape_all(const DrapeSurface& surface, const NetStart& start, const NetBox& box) {
  return drape_net(surface, start, box, std::vector<char>(static_cast<std::size_t>(box.size[0]) * box.size[1], 1));
}

// sin gamma = g1.g2 of the directions at the centre of cell (i, j)..(i+1, j+1)
inline double cell_angle(const DrapedNet& net, int i, int j) {
  const auto& x = net.position;
  const NetBox& b = net.box;
  const Vector3d &p00 = x[b.index(i, j)], &p10 = x[b.index(i + 1, j)], &p01 = x[b.index(i, j + 1)],
                 &p11 = x[b.index(i + 1, j + 1)];
  const Vector3d g1 = p10 - p00 + p11 - p01, g2 = p01 - p00 + p11 - p10;
  return std::atan2(g1.dot(g2), g1.cross(g2).norm());
}

inline double cell_orientation(const DrapedNet& net, const DrapeSurface& surface, int i, int j) {
  const auto& x = net.position;
  const NetBox& b = net.box;
  const Vector3d &p00 = x[b.index(i, j)], &p11 = x[b.index(i + 1, j + 1)];
  const Vector3d area = (p11 - p00).cross(x[b.index(i, j + 1)] - x[b.index(i + 1, j)]);
  int hint = 0;
  return area.dot(surface.at(0.5 * (p00 + p11), hint).gradient.normalized());
}

// Greatest relative error of the yarns' lengths.
inline double length_error(const DrapedNet& net, const NetStart& start) {
  double worst = 0.0;
  const NetBox& b = net.box;
  for (int j = b.low[1]; j < b.low[1] + b.size[1]; ++j)
    for (int i = b.low[0]; i < b.low[0] + b.size[0]; ++i)
      for (int f = 0; f < 2; ++f) {
        const int ni = i + (f == 0 ? 1 : 0), nj = j + (f == 1 ? 1 : 0);
        if (!b.holds(ni, nj)) continue;
        if (net.placed[b.index(i, j)] != Placed::yes || net.placed[b.index(ni, nj)] != Placed::yes) continue;
        const double length = (net.position[b.index(ni, nj)] - net.position[b.index(i, j)]).norm();
        worst = std::max(worst, std::abs(length / start.spacing[f] - 1.0));
      }
  return worst;
}

}  // namespace weaveform::test
