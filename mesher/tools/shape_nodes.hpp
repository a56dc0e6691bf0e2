// The triangles of a shape's faces as one surface.
#pragma once

#include <TopoDS_Shape.hxx>

#include "mesher/tools/triangle_list.hpp"

namespace weaveform {

// Each face has points of its own; those on a common edge or vertex become one, by the shape's own knowledge of what
// belongs together, whatever their distance. At a tip, where an edge has no length, all its points are one. Triangles
// that are left with fewer than three points are dropped. Triangles turn as their faces do.
[[nodiscard]] TriangleList joined_triangles(const TopoDS_Shape& shape);

}  // namespace weaveform
