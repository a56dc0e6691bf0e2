// A tool's surface from whatever file holds it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesher/tools/triangle_list.hpp"

namespace weaveform {

// By the ending, in any case of letters. Any other is taken for STL, which no ending need tell.
enum class SurfaceKind { stl, cad, mesh };
[[nodiscard]] SurfaceKind surface_kind(const std::filesystem::path& file);

struct SurfaceRequest {
  double millimetres = 1.0;       // to one of the file's units; 1 of STEP and IGES, which name theirs
  double chord_tolerance = 0.05;  // mm; CAD
  std::string set;  // meshes: shells of the instance, part or set of this name, where there is one; else all
};

struct FileSurface {
  TriangleList list;               // mm; as the file turns them
  double chord_error = 0.0;        // mm; CAD: greatest distance found to the true surface
  std::vector<std::string> words;  // what the file's reader complained of and passed over
};

// Throws FileError, InputError as the readers do (cad.hpp, stl.hpp, mesh_surface.hpp). CAD, which takes long, is made
// triangles of once for all who ask in the life of the process, unless a trusted script makes it.
[[nodiscard]] FileSurface read_surface(const std::filesystem::path& file, const SurfaceRequest& request);

}  // namespace weaveform
