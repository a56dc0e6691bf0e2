// What is wrong with a surface of triangles, by place; and turning its triangles alike.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/tools/triangles.hpp"

namespace weaveform {

struct SurfaceFault {
  std::array<double, 3> at = {0.0, 0.0, 0.0};  // mm
  double size = 0.0;                           // mm; length of a rim or gap, longest side of a triangle
};

struct TriangleReport {
  std::array<double, 3> low = {0.0, 0.0, 0.0}, high = {0.0, 0.0, 0.0};  // mm
  int triangles = 0;
  int pieces = 0;       // connected
  double area = 0.0;    // mm^2
  double volume = 0.0;  // mm^3; of a closed surface, negative when its normals point inward
  bool closed = false;
  std::vector<SurfaceFault> rims;           // loops of an open surface
  std::vector<SurfaceFault> gaps;           // rims that enclose next to nothing: faces that should meet and do not
  std::vector<SurfaceFault> degenerate;     // triangles without an area to speak of (height below 1e-6 of the extent)
  std::vector<SurfaceFault> intersections;  // a triangle that another, not its neighbour, passes through
  std::vector<SurfaceFault> turned;         // sides along which two triangles turn oppositely
  [[nodiscard]] double extent() const;      // mm; longest side of the box
};

[[nodiscard]] TriangleReport inspect(const TriangleList& list);
// One line a fault, a few of each kind; "" when there is none.
[[nodiscard]] std::string describe_faults(const TriangleReport& report);

// Triangles turned so that neighbours agree; closed pieces outward, open ones so that `outside` (a point) is on the
// positive side of the triangle nearest to it. Degenerate triangles are left out.
[[nodiscard]] TriangleList turned_alike(const TriangleList& list, const std::array<double, 3>& outside);
// A closed surface of negative volume.
[[nodiscard]] bool turned_inward(const TriangleList& list);
[[nodiscard]] TriangleList turned_over(TriangleList list);

}  // namespace weaveform
