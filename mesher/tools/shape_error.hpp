// How far the triangles of a shape lie from it.
#pragma once

#include <TopoDS_Shape.hxx>

namespace weaveform {

// mm; the greatest distance found from the middles of sides and the centres of a shape's triangles to its surfaces, and
// from the middles of chords to its edges.
[[nodiscard]] double chord_error(const TopoDS_Shape& shape);

}  // namespace weaveform
