// Surfaces of Gmsh scripts as triangles, in a guarded child with the script open in Gmsh (gmsh_session.hpp).
#pragma once

#include <filesystem>
#include <string>

#include "mesher/tools/cad.hpp"

namespace weaveform {

// Whether all faces are OpenCASCADE's, and so can be written as BREP; Gmsh's own kernel has no other form.
[[nodiscard]] bool is_all_opencascade();

// Faces of Gmsh's own kernel, meshed by Gmsh: sides sized by the sagitta from the greatest curvature of each face and
// curve, whatever the script says of meshes (sizes, fields, transfinite lines, recombined faces, order). The error is
// measured, and the triangles made finer until it is within `chord_tolerance` (mm). Throws InputError.
[[nodiscard]] CadSurface triangles_of_script(double chord_tolerance, const std::string& file);

}  // namespace weaveform
