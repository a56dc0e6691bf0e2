// Rigid moulds and tools in the mesh files of other codes (Abaqus .inp, Gmsh .msh): their shells as triangles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/tools/triangle_list.hpp"

namespace weaveform {

struct MeshSurface {
  TriangleList list;               // in the file's unit; as its shells turn
  std::vector<std::string> notes;  // what of the file was left out
};

// The three- and four-node shells of the instance, part or element set `name` (any case of letters) when the file has
// one of that name with shells in it, else all of the file's, instances in their places. Lines and points are passed
// over. Throws FileError, InputError as read_foreign_mesh (mesher/exchange/foreign_mesh.hpp), and when there is no
// shell.
[[nodiscard]] MeshSurface read_mesh_surface(const std::filesystem::path& file, const std::string& name = "");

}  // namespace weaveform
