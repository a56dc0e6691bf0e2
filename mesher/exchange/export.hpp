// A scene's mesh in the files of other codes: one writer per format, all from the same gathered model (gathered.hpp).
// Numbers in the files: node n of the mesh is node n + 1; yarn element e is element e + 1; the shells follow. Cells of
// five and six nodes are cut into a quadrilateral and a triangle, or two quadrilaterals, that share their area.
#pragma once

#include <string>
#include <vector>

#include "core/keys/choice.hpp"
#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

enum class MeshFormat { abaqus, calculix, lsdyna, openradioss, gmsh };
constexpr auto choices_of(MeshFormat) {
  return std::to_array<Choice<MeshFormat>>({{MeshFormat::abaqus, "abaqus"},
                                            {MeshFormat::calculix, "calculix"},
                                            {MeshFormat::lsdyna, "lsdyna"},
                                            {MeshFormat::openradioss, "openradioss"},
                                            {MeshFormat::gmsh, "gmsh"}});
}

// Whose laws: those that the code has itself, so that the file runs as it is, or user materials with the card's
// constants, whose routine is the reader's to supply.
enum class Materials { built_in, user };
constexpr auto choices_of(Materials) {
  return std::to_array<Choice<Materials>>({{Materials::built_in, "built-in"}, {Materials::user, "user"}});
}

struct ExportOptions {
  Materials materials = Materials::built_in;  // lsdyna, openradioss; abaqus always takes user materials
  bool is_static = false;                     // calculix: *STATIC instead of *DYNAMIC; plane scenes without tools
  std::string run_name = "fabric";            // openradioss: the file's name without _0000.rad
};

struct ExportedMesh {
  std::string text;                      // the whole file
  std::vector<std::string> not_carried;  // one line each: what the format cannot say; also in the file's header
  std::string engine = {};               // openradioss: the whole engine file, RUN_NAME_0001.rad; else empty
};

// `tools` are the scene's; `duration` (s) of the motion, which the scene may leave to the program. `written_by` goes
// into the header. Throws InputError when options do not go with the format or the scene.
[[nodiscard]] ExportedMesh export_mesh(MeshFormat format, const Scene& scene, const Card& card, const Mesh& mesh,
                                       const std::vector<Tool>& tools, double duration, const std::string& written_by,
                                       const ExportOptions& options = {});

}  // namespace weaveform
