// The measured points as one surface, so that every field is shown on the same grid and cut at the same levels.
#pragma once

#include <array>
#include <vector>

#include "post/dic/virtual/flat_mesh.hpp"
#include "post/output/contours.hpp"

namespace weaveform::dic {

// Delaunay triangles (CGAL) whose sides are at most `longest` (mm): holes in the measurement stay holes.
[[nodiscard]] std::vector<std::array<int, 3>> triangulate(const std::vector<Vec2>& points, double longest);

// Lines of equal value of a field (deg) that is linear on each triangle, at the multiples of `step` but for zero, each
// a chain of points (mm; z = 0). Triangles with a value that is not a number have none.
[[nodiscard]] std::vector<Isoline> isolines(const std::vector<Vec2>& points,
                                            const std::vector<std::array<int, 3>>& triangles,
                                            const std::vector<double>& value_deg, double step);

}  // namespace weaveform::dic
