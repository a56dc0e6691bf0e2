// Rigid moulds and tools in Abaqus input files: their shells as triangles.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/tools/triangle_list.hpp"

namespace weaveform {

// The three- and four-node shells of the element set `set` (any case of letters) when the file has one of that name
// with shells in it, else all of the file's; in the file's unit. What else is in it, lines and points, is passed over.
// Throws FileError, InputError as read_inp (mesher/import/foreign_mesh.hpp), and when there is no shell.
[[nodiscard]] TriangleList read_inp_surface(const std::filesystem::path& file, const std::string& set = "");

}  // namespace weaveform
