#include "post/report/result_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/files/files.hpp"
#include "fabric/card/builtin_cards.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "post/report/measured.hpp"
#include "post/report/page.hpp"
#include "post/report/part_json.hpp"
#include "post/report/run_charts.hpp"
#include "post/report/tools_json.hpp"
#include "post/report/verdict.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string card_text(const std::string& material, const Scene& scene) {
  for (const BuiltinCard& card : builtin_cards())
    if (card.name == material) return card.text;
  return read_text_file(card_path(material, scene.file));
}

// Of all plies, each once.
std::vector<std::string> materials_of(const Scene& scene) {
  if (scene.ply.empty()) return {scene.fabric.material};
  std::vector<std::string> materials;
  for (const PlySpec& ply : scene.ply)
    if (std::find(materials.begin(), materials.end(), ply.fabric.material) == materials.end())
      materials.push_back(ply.fabric.material);
  return materials;
}

std::string title_of(const SolveStatistics& statistics, const ResultFolder& folder) {
  const std::string scene = fs::path(statistics.scene).stem().string();
  return scene.empty() || scene == "scene" ? fs::weakly_canonical(folder.directory()).filename().string() : scene;
}

// A card by its name: the scene may know it by a path that means nothing to who reads the page.
std::string subtitle_of(const SolveStatistics& s, const Resolved& model) {
  std::vector<std::string> cards;
  for (std::size_t k = 0; k < model.plies(); ++k)
    if (const std::string& name = model.of_ply(k).card.name; std::find(cards.begin(), cards.end(), name) == cards.end())
      cards.push_back(name);
  return fmt::format("{}{} cells of {}, {} steps in {:.3g} s on {} thread{}",
                     model.ply.empty() ? "" : fmt::format("{} plies, ", model.ply.size()), s.cells,
                     fmt::join(cards, " and "), s.steps, s.wall_s, s.threads, s.threads == 1 ? "" : "s");
}

Json facts_of(const SolveStatistics& s, const Mesh& mesh) {
  Json facts = Json::array();
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) facts.push_back({name, value});
  };
  add("program", s.program);
  add("scene", s.scene);
  add("digest of the scene", s.scene_digest);
  add("digest of the card", s.card_digest);
  add("digest of the mesh", s.mesh_digest);
  add("mesh", fmt::format("{} cells, {} yarn elements, {} nodes; cells of {:.4g} x {:.4g} mm", s.cells, s.yarns,
                          s.nodes, mesh.spacing[0], mesh.spacing[1]));
  add("symmetry", s.symmetry == "none" ? "none: the whole was solved" : fmt::format("a {} was solved", s.symmetry));
  add("step",
      fmt::format("{:.3g} s at least, set by {}", s.step_s, s.step_set_by.empty() ? "the user" : s.step_set_by));
  add("damping", fmt::format("{:.3g} /s", s.damping_per_s));
  return facts;
}

}  // namespace

std::string result_report(ResultFolder& folder, const Evaluation& evaluation) {
  const Scene& scene = folder.scene();
  const SolveStatistics& statistics = folder.statistics();
  PartPage part = part_json(folder, evaluation.summary);
  Json data = {{"format", 1},
               {"kind", "result"},
               {"title", title_of(statistics, folder)},
               {"subtitle", subtitle_of(statistics, folder.model())},
               {"verdict", verdict_json(folder, evaluation)},
               {"part", nullptr},
               {"tools", tools_json(folder, part.frames, part.low, part.high)},
               {"measured", nullptr},
               {"charts", run_charts(folder, evaluation)},
               {"tables", Json::array()},
               {"texts", Json::array()},
               {"facts", facts_of(statistics, folder.model().mesh)}};
  data["part"] = std::move(part.json);
  if (auto measured = measured_page(folder, part.frames)) {
    data["measured"] = std::move(measured->field);
    for (Json& chart : measured->charts) data["charts"].push_back(std::move(chart));
    data["tables"].push_back(std::move(measured->table));
  }
  data["texts"].push_back({{"title", "Scene"}, {"text", read_text_file(folder.directory() / file_name::scene)}});
  for (const std::string& material : materials_of(scene))
    data["texts"].push_back({{"title", fmt::format("Material card {}", fs::path(material).filename().string())},
                             {"text", card_text(material, scene)}});
  return report_page(data);
}

void write_report_page(ResultFolder& folder, const Evaluation& evaluation, const fs::path& file) {
  write_text_whole(file, result_report(folder, evaluation));
}

}  // namespace weaveform
