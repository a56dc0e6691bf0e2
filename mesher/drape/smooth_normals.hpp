// The normals of the smooth surface that a tool of triangles stands for, for directions that are carried along it.
//
// On the triangles themselves all curvature sits in the vertices. A line that is straight from facet to facet takes
// nothing of the angle deficit of a vertex that it passes, however near, so that one that runs beside a row of vertices
// a distance d = phi h away drifts as if the surface had a geodesic curvature of K h (1/2 - phi), of first order in the
// facets' size h, and one that meets the vertices themselves takes as their side what rounding decides. With a normal
// that is the bisecting one at vertices and linear in between, the plane of the line and the normal turns it at every
// edge by the edge's own dihedral angle times the tilt of the normal along the edge, which makes up for just that: at
// a vertex the total angle is halved (the straightest geodesics of Polthier and Schmies 1998), beside it the line takes
// its share. On developable triangles normals do not tilt along edges, and the line stays straight in the unfolding.
//
// Vertex normals are weighted by angles (Thuermer and Wuethrich 1998): second order where triangles lie evenly around
// the vertex. A corner counts only what is smooth with its own triangle: triangles around the vertex whose normals are
// within 30 deg of its own, reached over edges that turn by less than that. Sharper edges stay as they are.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesher/tools/triangles.hpp"

namespace weaveform {

class SmoothNormals {
public:
  explicit SmoothNormals(const TriangleSurface& surface);
  // Unit, outward; at a point of the triangle.
  [[nodiscard]] Eigen::Vector3d at(int triangle, const Eigen::Vector3d& point) const;

private:
  struct Facet {
    std::array<Eigen::Vector3d, 3> corner, normal;
  };
  std::vector<Facet> facet_;
};

}  // namespace weaveform
