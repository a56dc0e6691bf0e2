// The two yarns that carry the net: nodes at a fixed chord length along a geodesic or a given curve.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mesher/drape/surface.hpp"

namespace weaveform {

// Nodes of one yarn to one side of the seed, nearest first. Fewer than asked when nothing of the surface is in reach.
struct Generator {
  std::vector<Eigen::Vector3d> node;
  std::vector<char> beyond;  // per node: past a rim or over a hole
};

// From `seed` (on the surface) along the tangent `direction`: `count` nodes, each `chord` (mm) from the one before.
// The geodesic is marched in steps of chord/32: the next point lies in the plane of the last step and the surface's
// normal, which is exact for great circles and helices and of second order elsewhere (the error of such a step is some
// thousand times below that of a cell); on triangles it is the straight line from facet to
// facet, turned at edges by the tilt of the smooth surface's normal (smooth_normals.hpp).
[[nodiscard]] Generator geodesic(const DrapeSurface& surface, const Eigen::Vector3d& seed,
                                 const Eigen::Vector3d& direction, double chord, int count);

// The same along a polyline that starts at the seed; every point of it is moved to the surface along the gradient.
// Beyond its end the yarn goes on along the geodesic.
[[nodiscard]] Generator along_curve(const DrapeSurface& surface, const Eigen::Vector3d& seed,
                                    const std::vector<Eigen::Vector3d>& curve, double chord, int count);

// One node more, `length` (mm) from `x` along the geodesic that leaves it in `direction`; none beyond a rim.
[[nodiscard]] std::optional<Eigen::Vector3d> next_along(const DrapeSurface& surface, const Eigen::Vector3d& x,
                                                        const Eigen::Vector3d& direction, double length, int& hint);

}  // namespace weaveform
