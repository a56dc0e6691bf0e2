// A scene's mesh in the files of other codes: one writer per format, all from the same gathered model (gathered.hpp).
// Numbers in the files: node n of the mesh is node n + 1; yarn element e is element e + 1; the shells follow. Cells of
// five and six nodes are cut into a quadrilateral and a triangle, or two quadrilaterals, that share their area.
#pragma once

#include <string>
#include <vector>

#include "mesher/material/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

enum class MeshFormat { abaqus, lsdyna, openradioss, gmsh };

struct ExportedMesh {
  std::string text;                      // the whole file
  std::vector<std::string> not_carried;  // one line each: what the format cannot say; also in the file's header
};

// `duration` (s) of the motion, which the scene may leave to the program. `written_by` goes into the header. Throws
// InputError when a tool's profile or file is none, FileError when that file cannot be read.
[[nodiscard]] ExportedMesh export_mesh(MeshFormat format, const Scene& scene, const Card& card, const Mesh& mesh,
                                       double duration, const std::string& written_by);

}  // namespace weaveform
