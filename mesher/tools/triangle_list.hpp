// A surface as a plain list of triangles, and what every such list must fulfil, wherever it is read from.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace weaveform {

struct TriangleList {
  std::vector<std::array<double, 3>> point;  // mm
  std::vector<std::array<int, 3>> triangle;
};

// No tool and no blank is larger (in the unit of its file; mm when it names none): corners beyond are damage or NaN.
inline constexpr double farthest_corner = 1e7;

// Throws InputError, beginning with `where`, unless all triangles name points that are there and all corners are
// within farthest_corner of the origin; says which triangle, from 1.
void require_sound(const TriangleList& list, const std::string& where);

}  // namespace weaveform
