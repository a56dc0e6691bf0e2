#include "app/stages/mesh_json.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "core/json/toml_json.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

nlohmann::ordered_json mesh_json(const Resolved& model) {
  const Mesh& mesh = model.mesh;
  nlohmann::ordered_json json = {
      {"cells", mesh.cells.size()}, {"yarn_elements", mesh.yarn_count()}, {"nodes", mesh.node_count()}};
  if (model.ply.empty()) {
    json["spacing_mm"] = mesh.spacing;
    json["coarsening"] =
        std::array{mesh.spacing[1] / model.card.yarn[0].interval, mesh.spacing[0] / model.card.yarn[1].interval};
    return json;
  }
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    const Resolved& ply = model.ply[k];
    nlohmann::ordered_json own = mesh_json(ply);
    own["material"] = ply.card.name;
    own["thickness_mm"] = ply.mesh.thickness;
    own["position_mm"] = ply.scene.blank.position;
    json["plies"][mesh.ply[k].name] = std::move(own);
  }
  return json;
}

nlohmann::ordered_json check_json(const Resolved& model, const ExpectedRun& expected, const std::string& not_chosen,
                                  const std::string& resolved) {
  nlohmann::ordered_json json = {{"mesh", mesh_json(model)},
                                 {"expected",
                                  {{"cells_solved", expected.cells_solved},
                                   {"steps", expected.steps},
                                   {"step_s", expected.step},
                                   {"wall_s", expected.wall},
                                   {"memory_MB", 1e-6 * expected.memory}}},
                                 {"scene", toml_file_json(scene_to_toml(model.scene), model.scene.file)}};
  if (!not_chosen.empty()) json["not_chosen"] = not_chosen;
  if (!resolved.empty()) json["resolved"] = toml_file_json(resolved, model.scene.file).at("resolved");
  return json;
}

}  // namespace weaveform
