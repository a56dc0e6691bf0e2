#include "mesher/scene/taken.hpp"

#include <algorithm>

#include "core/keys/choice_value.hpp"

namespace weaveform {
namespace {

// Each open key with its names in a record, of a scene of one ply and in a [[ply]].
struct OpenKey {
  const char* whole;
  const char* of_ply;
  bool (*open)(const BlankSpec&, const ModelSpec&);
  TomlText (*value)(const BlankSpec&, const ModelSpec&);
};

constexpr OpenKey open_keys[] = {
    {"blank.coarsening", "coarsening", [](const BlankSpec& blank, const ModelSpec&) { return blank.coarsening_open; },
     [](const BlankSpec& blank, const ModelSpec&) { return toml_text(blank.coarsening); }},
    {"model.yarn", "yarn", [](const BlankSpec&, const ModelSpec& model) { return model.yarn_open; },
     [](const BlankSpec&, const ModelSpec& model) { return toml_text(model.yarn); }},
    {"model.cell", "cell", [](const BlankSpec&, const ModelSpec& model) { return model.cell_open; },
     [](const BlankSpec&, const ModelSpec& model) { return toml_text(model.cell); }},
};

std::string key_of_ply(const std::string& ply, const OpenKey& key) {
  return "ply." + ply + "." + key.of_ply;
}

// What `look` makes of the place of an open key; `otherwise` where the scene has no such place.
template <class Value, class Look>
Value at_key(const Scene& scene, const std::string& name, Value otherwise, Look look) {
  for (const OpenKey& key : open_keys) {
    if (scene.ply.empty() && name == key.whole) return look(key, scene.blank, scene.model);
    for (const PlySpec& ply : scene.ply)
      if (name == key_of_ply(ply.name, key)) return look(key, ply.blank, ply.model);
  }
  return otherwise;
}

// The tool whose speed this key is; null when it is none.
const ToolSpec* tool_of(const Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.tools.begin(), scene.tools.end(),
                                  [&](const ToolSpec& tool) { return name == speed_key(tool.name); });
  return found == scene.tools.end() ? nullptr : &*found;
}

// As in the file; none of an open key, and of one that no record is about.
TomlText value_of(const Scene& scene, const std::string& name) {
  if (name == duration_key) return scene.analysis.duration ? toml_text(*scene.analysis.duration) : TomlText();
  if (const ToolSpec* tool = tool_of(scene, name)) return toml_text(tool->speed);
  return at_key(scene, name, TomlText(), [](const OpenKey& key, const BlankSpec& blank, const ModelSpec& model) {
    return key.open(blank, model) ? TomlText() : key.value(blank, model);
  });
}

}  // namespace

std::string speed_key(const std::string& tool) {
  return "tools." + tool + ".speed";
}

bool leaves_open(const BlankSpec& blank, const ModelSpec& model) {
  return blank.coarsening_open || model.yarn_open || model.cell_open;
}

bool leaves_open(const Scene& scene) {
  if (scene.ply.empty()) return leaves_open(scene.blank, scene.model);
  return std::any_of(scene.ply.begin(), scene.ply.end(),
                     [](const PlySpec& ply) { return leaves_open(ply.blank, ply.model); });
}

bool leaves_open(const Scene& scene, const std::string& name) {
  const AnalysisSpec& analysis = scene.analysis;
  if (name == duration_key) return analysis.inertia && !analysis.duration && !analysis.loading_speed;
  if (const ToolSpec* tool = tool_of(scene, name))
    return leaves_open(scene, duration_key) && tool->travel != 0.0 && tool->speed.empty();
  return at_key(scene, name, false, [](const OpenKey& key, const BlankSpec& blank, const ModelSpec& model) {
    return key.open(blank, model);
  });
}

const TakenSpec* find_taken(const Scene& scene, const std::string& key) {
  const auto found =
      std::find_if(scene.taken.begin(), scene.taken.end(), [&](const TakenSpec& taken) { return taken.key == key; });
  return found == scene.taken.end() ? nullptr : &*found;
}

void drop_overruled(Scene& scene) {
  std::erase_if(scene.taken, [&](const TakenSpec& taken) { return value_of(scene, taken.key) != taken.value; });
}

std::vector<TakenSpec> taken_of_ply(const std::vector<TakenSpec>& taken, const std::string& ply) {
  std::vector<TakenSpec> own;
  for (const TakenSpec& one : taken) {
    TakenSpec& kept = own.emplace_back(one);
    if (!one.key.starts_with("ply.")) continue;
    const auto key = std::find_if(std::begin(open_keys), std::end(open_keys),
                                  [&](const OpenKey& open) { return one.key == key_of_ply(ply, open); });
    if (key == std::end(open_keys))
      own.pop_back();
    else
      kept.key = key->whole;
  }
  return own;
}

TakenSpec of_stack(TakenSpec taken, const std::string& ply) {
  for (const OpenKey& key : open_keys)
    if (taken.key == key.whole) taken.key = key_of_ply(ply, key);
  return taken;
}

std::vector<std::string> taken_lines(const Scene& scene) {
  std::vector<std::string> lines;
  for (const TakenSpec& taken : scene.taken) lines.push_back(taken.key + " = " + taken.value + ": " + taken.why);
  return lines;
}

std::vector<std::string> missed_lines(const Scene& scene) {
  std::vector<std::string> lines;
  for (const TakenSpec& taken : scene.taken)
    if (!taken.missed.empty()) lines.push_back(taken.key + " = " + taken.value + ": " + taken.missed);
  return lines;
}

std::vector<std::string> as_overrides(const std::vector<TakenSpec>& taken, const Scene& scene) {
  std::vector<std::string> overrides;
  for (const TakenSpec& one : taken)
    if (leaves_open(scene, one.key)) overrides.push_back(one.key + "=" + one.value);
  return overrides;
}

}  // namespace weaveform
