// A tool from CAD: a surface of triangles, its outside where their vertices run counter-clockwise. Closest points are
// exact (to rounding), found through a tree of bounding boxes.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "mesher/tools/triangle_list.hpp"

namespace weaveform {

struct SurfaceDistance {
  double distance;               // mm; negative inside
  std::array<double, 3> normal;  // unit; outward, from the closest point of the surface to the point (or back, inside)
  int triangle;                  // the closest
  bool beyond = false;           // the point lies past a rim of an open surface, or over a hole in it
};

class TriangleSurface {
public:
  // Throws InputError, beginning with `where`, when there is no triangle or neighbours do not turn the same way.
  TriangleSurface(const TriangleList& list, const std::string& where);
  ~TriangleSurface();
  TriangleSurface(const TriangleSurface&) = delete;
  TriangleSurface& operator=(const TriangleSurface&) = delete;

  // `hint` is a triangle likely to be near, such as the answer a step ago; it saves time and changes no distance.
  // Inside or outside follows from the angle-weighted pseudo-normal of the closest face, edge or vertex (Baerentzen and
  // Aanaes 2005, "Signed distance computation using the angle weighted pseudonormal"), right for every closed surface.
  [[nodiscard]] SurfaceDistance distance(const std::array<double, 3>& point, int hint = 0) const;
  // Unit, outward; of one triangle.
  [[nodiscard]] std::array<double, 3> face_normal(int triangle) const;
  [[nodiscard]] int size() const;
  // Of one triangle, counter-clockwise from outside.
  [[nodiscard]] std::array<std::array<double, 3>, 3> corners(int triangle) const;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace weaveform
