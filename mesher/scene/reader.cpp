#include "mesher/scene/reader.hpp"

#include <algorithm>
#include <filesystem>

#include "core/files/files.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/keys/toml_document.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/check.hpp"
#include "mesher/scene/overrides.hpp"
#include "mesher/scene/schema.hpp"
#include "mesher/scene/taken.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {
namespace {

void complain_unknown_tables(const toml::table& root, Complaints& complaints) {
  std::vector<std::string> names;
  for (const auto& table : scene_tables()) names.push_back(table.name);
  for (const auto& [name, node] : root) {
    if (std::find(names.begin(), names.end(), name.str()) != names.end()) continue;
    complaints.add(name.source(),
                   std::string(node.is_value() ? "no key belongs outside a table: '" : "unknown table '") +
                       std::string(name.str()) + "'" + did_you_mean(name.str(), names));
  }
}

// Written out, "auto" asks more than a duration that is left out: of tools that travel, one by the share of inertia. An
// echo, which has every key, has `inertia` too, so that it says what its scene said.
void ask_for_share(const toml::table& root, Scene& scene) {
  const toml::table* analysis = root["analysis"].as_table();
  if (analysis == nullptr || analysis->contains("inertia")) return;
  const bool travel =
      std::any_of(scene.tools.begin(), scene.tools.end(), [](const ToolSpec& tool) { return tool.travel != 0.0; });
  if (travel && (*analysis)["duration"].value<std::string>() == "auto") scene.analysis.inertia = inertia_of_auto;
}

}  // namespace

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  return read_scene_text(read_text_file(file, most_written_by_hand), file.string(), overrides);
}

Scene read_scene_text(const std::string& text, const std::string& name, const std::vector<std::string>& overrides) {
  Complaints complaints(name);
  toml::table root = parse_toml(text, name);
  apply_overrides(root, overrides, complaints);
  Scene scene;
  scene.file = name;
  complain_unknown_tables(root, complaints);
  for (const auto& table : scene_tables()) {
    if (const toml::node* node = root.get(table.name)) table.read(*node, scene, complaints);
  }
  check_scene(scene, root, complaints);
  complaints.throw_if_any();
  ask_for_share(root, scene);
  drop_overruled(scene);
  return scene;
}

Scene with_absolute_paths(Scene scene) {
  const auto make_absolute = [&](std::string& path) {
    if (path.empty() || std::filesystem::path(path).is_absolute()) return;
    path = std::filesystem::absolute(std::filesystem::path(scene.file).parent_path() / path).lexically_normal();
  };
  const auto make_card_absolute = [&](std::string& material) {
    if (is_builtin_card(material)) return;
    material = std::filesystem::absolute(card_path(material, scene.file)).lexically_normal();
  };
  for (ToolSpec& tool : scene.tools)
    if (!tool.file.empty()) tool.file = std::filesystem::absolute(tool_path(tool.file, scene.file)).lexically_normal();
  make_absolute(scene.blank.outline);
  make_card_absolute(scene.fabric.material);
  for (PlySpec& ply : scene.ply) {
    make_absolute(ply.blank.outline);
    make_card_absolute(ply.fabric.material);
  }
  make_absolute(scene.stack.friction_law);
  make_absolute(scene.stack.compaction);
  for (PairSpec& pair : scene.stack.pair) {
    make_absolute(pair.friction_law);
    make_absolute(pair.compaction);
  }
  return scene;
}

std::string scene_to_toml(const Scene& scene) {
  std::string text = "# Every value of the scene. Units: mm, s, N, MPa, tonne; angles in degrees.\n";
  for (const auto& table : scene_tables()) text += table.write(scene);
  return text;
}

std::vector<KeyInfo> scene_keys() {
  std::vector<KeyInfo> keys;
  for (const auto& table : scene_tables()) keys.insert(keys.end(), table.keys.begin(), table.keys.end());
  return keys;
}

std::string scene_reference_markdown() {
  std::string text =
      "# Scene reference\n\n"
      "Generated from the key tables in `mesher/scene/*_keys.cpp`. A scene is a TOML file. Units: mm, s, N, MPa, "
      "tonne; "
      "angles in degrees. A whole number is accepted where a number is wanted. `\"auto\"` lets the program choose.\n\n"
      "`--set TABLE.KEY=VALUE` replaces any value from the command line; an element of a list of tables is named or "
      "counted from 0: `--set blank.size=[100,200]`, `--set grip.top.travel=40`, `--set grip.0.travel=40`, "
      "`--set tools.punch.travel=60`.\n";
  for (const auto& table : scene_tables()) {
    const std::string title = table.named ? "[" + table.name + ".NAME]" : "[" + table.name + "]";
    text += "\n## `" + (table.many ? "[" + title + "]" : title) + "`\n\n";
    text += table.doc + "\n\n" + markdown_table(table.keys);
  }
  return text;
}

}  // namespace weaveform
