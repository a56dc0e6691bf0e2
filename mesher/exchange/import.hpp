// A mesh of another code made one of ours: bit for bit when Weaveform wrote it, else recovered from its geometry.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct ImportedMesh {
  Mesh mesh;
  std::string scene;               // TOML; only of a file that Weaveform wrote
  std::vector<std::string> notes;  // what was found, guessed or left out; one line each
  std::string scene_name = {};     // the file that `scene` was read from
};

// From the weaveform lines of the file. Throws InputError unless its nodes (to 1e-9 of the mesh's extent) and elements
// are those that the lines describe: a file changed since has to be imported as foreign, its lines removed.
[[nodiscard]] ImportedMesh import_own(const ForeignMesh& file);

// From geometry: a flat blank of straight yarns at right angles and even spacing (to 1e-5 of it), cut by any outline.
// Lines are yarns, shells the cells. Their two directions are the families: the warp is what the element set `warp`
// says, else the direction nearest to the scene's yarn_angle. Node sets named like the scene's grips hold it. Yarns per
// line from the area beside it and the card's interval; masses, jaws, soft and tied ends as for our own mesh. Shells
// named like a tool of shape "triangles" are left out (tool_surface). `part` names the fabric's part or instance where
// several could be it (choose_fabric.hpp); `others` are parts of which nothing is noted, those of other plies. Throws
// InputError with what does not fit.
[[nodiscard]] ImportedMesh import_foreign(const ForeignMesh& file, const Scene& scene, const Card& card,
                                          const std::string& part = "", const std::vector<std::string>& others = {});

// The shells with a tool's name (shells_named) as STL text, when there are any.
[[nodiscard]] std::optional<std::string> tool_surface(const ForeignMesh& file, const std::string& tool);

}  // namespace weaveform
