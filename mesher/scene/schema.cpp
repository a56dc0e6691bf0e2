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

}  // namespace

const std::vector<SceneTable>& scene_tables() {
  static const std::vector<SceneTable> tables = {
      one_table<&Scene::fabric>("fabric", fabric_keys(), "The woven reinforcement."),
      one_table<&Scene::blank>("blank", blank_keys(),
                               "The flat piece of fabric and how finely its yarns are modelled."),
      one_table<&Scene::model>("model", model_keys(), "Elements and laws."),
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
  };
  return tables;
}

}  // namespace weaveform
