// Shapes of OpenCASCADE as triangles, sized by the sagitta alone: a flat face of four sides is two of them, a fillet
// has as many chords round its arc as the tolerance asks for and one along it (BRepMesh of OpenCASCADE). In a guarded
// child only.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>

#include "mesher/tools/cad.hpp"

namespace weaveform {

// All faces, each once; triangles of faces that share an edge share its points, so that the surface is closed where the
// shape is. Faces that only lie side by side (IGES knows no others) are sewn first. The error is measured, and the
// triangles made finer until it is within `chord_tolerance` (mm). Throws InputError, beginning with `file`.
[[nodiscard]] CadSurface triangles_of_shape(const TopoDS_Shape& shape, double chord_tolerance, const std::string& file);

// Of the extent: the widest gap that is sewn, so that a part's own details are not.
inline constexpr double widest_gap = 1e-4;

// mm; of the box round it.
[[nodiscard]] double extent_of(const TopoDS_Shape& shape);

// Faces that lie side by side within `gap` (mm) and do not know each other made one shell; the shape itself when all
// do.
[[nodiscard]] TopoDS_Shape sewn_where_open(const TopoDS_Shape& shape, double gap);

}  // namespace weaveform
