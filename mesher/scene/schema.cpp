#include "mesher/scene/schema.hpp"

#include "mesher/scene/scene_keys.hpp"

namespace weaveform {
namespace {

void complain_form(const toml::node& node, const std::string& name, bool many, Complaints& complaints) {
  complaints.add(node, many ? "'" + name + "' is a list of tables; begin each with [[" + name + "]]"
                            : "'" + name + "' is one table; begin it with [" + name + "]");
}

void complain_named(const toml::node& node, const std::string& name, Complaints& complaints) {
  complaints.add(node, "'" + name + "' is a group of named tables; begin each with [" + name + ".NAME]");
}

template <class Spec>
void read_one(const toml::node& node, const std::string& name, const std::vector<Key<Spec>>& keys, Spec& spec,
              bool many, Complaints& complaints) {
  const auto* table = node.as_table();
  if (table == nullptr) return complain_form(node, name, many, complaints);
  const std::string title = many ? "[[" + name + "]]" : "[" + name + "]";
  read_keys(*table, title, keys, spec, complaints);
  require_keys(*table, title, keys, complaints);
}

// [name]: one table, a struct of the scene.
template <auto member, class Spec>
SceneTable one_table(const std::string& name, const std::vector<Key<Spec>>& keys, const std::string& doc) {
  SceneTable table{.name = name, .many = false, .doc = doc, .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    read_one(node, name, keys, scene.*member, false, complaints);
  };
  table.write = [name, &keys](const Scene& scene) { return "\n[" + name + "]\n" + write_keys(keys, scene.*member); };
  return table;
}

// [name.NAME]: a table of named tables, a vector of the scene in the order of the names.
template <auto member, class Spec>
SceneTable named_tables(const std::string& name, const std::vector<Key<Spec>>& keys, const std::string& doc) {
  SceneTable table{.name = name, .many = false, .named = true, .doc = doc, .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    const auto* group = node.as_table();
    if (group == nullptr) return complain_named(node, name, complaints);
    for (const auto& [given, item] : *group) {
      const std::string title = name + "." + std::string(given.str());
      if (!is_identifier(given.str())) {
        complaints.add(item,
                       "[" + title + "]: a name begins with a letter and holds only letters, digits, '_' and '-'");
      } else if (!item.is_table()) {
        complain_named(item, name, complaints);
      } else {
        Spec& spec = (scene.*member).emplace_back();
        spec.name = given.str();
        read_one(item, title, keys, spec, false, complaints);
      }
    }
  };
  table.write = [name, &keys](const Scene& scene) {
    std::string text;
    for (const Spec& spec : scene.*member)
      text += "\n[" + name + "." + spec.name + "]\n" + write_keys(keys, spec, Echo::given);
    return text;
  };
  return table;
}

// [name] that a scene may do without.
template <auto member, class Spec>
SceneTable optional_table(const std::string& name, const std::vector<Key<Spec>>& keys, const std::string& doc) {
  SceneTable table{.name = name, .many = false, .doc = doc, .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    read_one(node, name, keys, (scene.*member).emplace(), false, complaints);
  };
  table.write = [name, &keys](const Scene& scene) {
    return scene.*member ? "\n[" + name + "]\n" + write_keys(keys, *(scene.*member)) : std::string();
  };
  return table;
}

// [[name]]: a list of tables, a vector of the scene. An element that cannot be read keeps its place, so that the n-th
// element is the n-th table of the file.
template <auto member, class Spec>
SceneTable many_tables(const std::string& name, const std::vector<Key<Spec>>& keys, const std::string& doc) {
  SceneTable table{.name = name, .many = true, .doc = doc, .keys = describe_keys(name, keys)};
  table.read = [name, &keys](const toml::node& node, Scene& scene, Complaints& complaints) {
    const auto* list = node.as_array();
    if (list == nullptr) return complain_form(node, name, true, complaints);
    for (const auto& item : *list) {
      Spec& spec = (scene.*member).emplace_back();
      read_one(item, name, keys, spec, true, complaints);
    }
  };
  table.write = [name, &keys](const Scene& scene) {
    std::string text;
    for (const Spec& spec : scene.*member) text += "\n[[" + name + "]]\n" + write_keys(keys, spec);
    return text;
  };
  return table;
}

// Before a ply's table is read over what it takes over: a file's unit and layers go with that file, and of the two ways
// to place lines the ply's own counts.
void make_way(const toml::table& table, BlankSpec& blank) {
  if (table.contains("outline")) {
    blank.outline_unit.reset();
    blank.outline_layers.clear();
  }
  if (table.contains("phase") || table.contains("fit")) blank.on_roll.reset();
  if (table.contains("on_roll")) blank.phase = {0.0, 0.0};
}

// Afterwards: what was taken over but is of no use to the ply's own shape, elements and laws is left behind.
void leave_behind(const toml::table& table, PlySpec& ply) {
  const auto taken_over = [&](const char* key) { return !table.contains(key); };
  BlankSpec& blank = ply.blank;
  if (blank.shape != BlankShape::polygon && taken_over("corners")) blank.corners.clear();
  if (blank.shape != BlankShape::cross && taken_over("arm_width")) blank.arm_width.reset();
  if (blank.shape != BlankShape::file) {
    if (taken_over("outline")) blank.outline.clear();
    if (taken_over("outline_unit")) blank.outline_unit.reset();
    if (taken_over("outline_layers")) blank.outline_layers.clear();
  }
  ModelSpec& model = ply.model;
  const bool beam = model.yarn_open || model.yarn == YarnElement::beam;  // or may come to be one
  const bool bending_cell = model.cell_open || model.cell != CellElement::membrane;
  if (!model.yarn_open && model.yarn != YarnElement::seatbelt && taken_over("partner"))
    model.partner = SeatbeltPartner::none;
  if (!beam && taken_over("yarn_bending")) model.yarn_bending.reset();
  if (!carries_compression(model) && taken_over("compression_modulus")) model.compression_modulus.reset();
  if (!bending_cell && taken_over("cell_bending")) model.cell_bending.reset();
  if (!bending_cell && !beam && taken_over("bending_friction")) model.bending_friction.reset();
  if (!model.cell_open && model.cell != CellElement::shell && taken_over("transverse_shear"))
    model.transverse_shear.reset();
  if (model.yarn_law != YarnLaw::slack && taken_over("slack")) model.slack.reset();
}

// [[ply]]: what is left out is that of the tables read before, [fabric], [blank] and [model].
SceneTable ply_tables() {
  SceneTable table{.name = "ply", .many = true, .doc = "", .keys = describe_keys("ply", ply_keys())};
  for (KeyInfo& key : table.keys) key.standard.clear();
  table.doc =
      "A ply of a stack, from the lowest up along z; as many as there are. Left out: one ply, that of `[fabric]`, "
      "`[blank]` and `[model]`, whose values also are those that a ply leaves out (docs/plies.md).";
  table.read = [](const toml::node& node, Scene& scene, Complaints& complaints) {
    const auto* list = node.as_array();
    if (list == nullptr) return complain_form(node, "ply", true, complaints);
    for (const auto& item : *list) {
      PlySpec& ply = scene.ply.emplace_back();
      ply.fabric = scene.fabric;
      ply.blank = scene.blank;
      ply.model = scene.model;
      const auto* given = item.as_table();
      if (given != nullptr) make_way(*given, ply.blank);
      read_one(item, "ply", ply_keys(), ply, true, complaints);
      if (given != nullptr) leave_behind(*given, ply);
    }
  };
  table.write = [](const Scene& scene) {
    std::string text;
    for (const PlySpec& ply : scene.ply) text += "\n[[ply]]\n" + write_keys(ply_keys(), ply);
    return text;
  };
  return table;
}

void read_pairs(const toml::node& node, StackSpec& stack, Complaints& complaints) {
  const auto* list = node.as_array();
  if (list == nullptr) return complain_form(node, "stack.pair", true, complaints);
  for (const auto& item : *list) read_one(item, "stack.pair", pair_keys(), stack.pair.emplace_back(), true, complaints);
}

// [stack] and its list [[stack.pair]]; of a scene with plies only.
SceneTable stack_table() {
  SceneTable table{.name = "stack",
                   .doc =
                       "How the plies of a stack lie and slide on each other. Two plies may have numbers of their own "
                       "in a `[[stack.pair]]`: `pair.plies`, and any of the others as `pair.NAME`.",
                   .keys = describe_keys("stack", stack_keys())};
  for (KeyInfo& key : describe_keys("stack", pair_keys())) {
    key.name = "pair." + key.name;
    table.keys.push_back(std::move(key));
  }
  table.read = [](const toml::node& node, Scene& scene, Complaints& complaints) {
    const auto* given = node.as_table();
    if (given == nullptr) return complain_form(node, "stack", false, complaints);
    read_keys(*given, "[stack]", stack_keys(), scene.stack, complaints, {"pair"});
    if (const toml::node* pairs = given->get("pair")) read_pairs(*pairs, scene.stack, complaints);
  };
  table.write = [](const Scene& scene) {
    if (scene.ply.empty()) return std::string();
    std::string text = "\n[stack]\n" + write_keys(stack_keys(), scene.stack);
    for (const PairSpec& pair : scene.stack.pair) text += "\n[[stack.pair]]\n" + write_keys(pair_keys(), pair);
    return text;
  };
  return table;
}

}  // namespace

const std::vector<SceneTable>& scene_tables() {
  static const std::vector<SceneTable> tables = {
      one_table<&Scene::fabric>("fabric", fabric_keys(), "The woven reinforcement."),
      one_table<&Scene::blank>("blank", blank_keys(),
                               "The flat piece of fabric and how finely its yarns are modelled."),
      one_table<&Scene::model>("model", model_keys(), "Elements and laws."),
      ply_tables(),
      stack_table(),
      many_tables<&Scene::grip>("grip", grip_keys(), "A prescribed part of the blank; as many as needed."),
      optional_table<&Scene::frame>(
          "frame", frame_keys(),
          "A pin-jointed shear frame around a square blank: the fabric is blank.size, its yarns run "
          "on to the frame through arms without cross yarns. Left out: no frame."),
      named_tables<&Scene::tools>("tools", tool_keys(),
                                  "A rigid tool; as many as needed, each with a name of its own: it heads the tool's "
                                  "columns in history.csv and names it in `--set tools.NAME.travel=...`."),
      optional_table<&Scene::drape>("drape", drape_keys(),
                                    "The blank starts draped over a tool, as a pin-jointed net of inextensible yarns "
                                    "(docs/drape.md). Left out: it "
                                    "starts flat."),
      one_table<&Scene::analysis>("analysis", analysis_keys(), "The explicit analysis."),
      one_table<&Scene::output>("output", output_keys(), "What is written."),
      many_tables<&Scene::measure>("measure", measure_keys(),
                                   "A patch of cells whose mean shear angle is recorded; as many as needed."),
      optional_table<&Scene::accuracy>("accuracy", accuracy_keys(),
                                       "What is wanted of the answers, where `blank.coarsening`, `model.yarn` or "
                                       "`model.cell` is `\"auto\"` (docs/automatic.md)."),
      many_tables<&Scene::taken>("taken", taken_keys(),
                                 "Written by the program into a folder's scene: what it took where the scene left that "
                                 "to it, and why. An entry whose key has another value is passed over."),
  };
  return tables;
}

}  // namespace weaveform
