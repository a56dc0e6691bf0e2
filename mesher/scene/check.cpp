#include "mesher/scene/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "core/keys/nearest_name.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/check_tools.hpp"

namespace weaveform {
namespace {

// The table of a [table] or of the index-th [[table]]; null when the file has no such thing.
const toml::table* table_at(const toml::table& root, const char* name, std::size_t index) {
  const toml::node* node = root.get(name);
  if (node != nullptr && node->is_array()) node = node->as_array()->get(index);
  return node == nullptr ? nullptr : node->as_table();
}

void check_box(const std::array<double, 4>& box, const toml::table& table, const char* key, Complaints& complaints) {
  if (box[0] < box[2] && box[1] < box[3]) return;
  complaints.add(place_of(table, key), fmt::format("'{}' is [{}, {}, {}, {}]; it must be xmin < xmax and ymin < ymax",
                                                   key, box[0], box[1], box[2], box[3]));
}

// Exactly one of two keys, judged by the file so that a key with a bad value is not called missing too.
void check_one_of(const toml::table& table, const char* title, const char* one, const char* other,
                  Complaints& complaints) {
  if (table.contains(one) && table.contains(other)) {
    complaints.add(place_of(table, other), fmt::format("{} has both '{}' and '{}'; keep one", title, one, other));
  } else if (!table.contains(one) && !table.contains(other)) {
    complaints.add(table, fmt::format("{} has neither '{}' nor '{}'; add one", title, one, other));
  }
}

template <class Spec>
void check_names(const std::vector<Spec>& specs, const toml::table& root, const char* list, Complaints& complaints) {
  std::map<std::string, std::size_t> first;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const toml::table* table = table_at(root, list, i);
    if (table == nullptr || specs[i].name.empty() || first.emplace(specs[i].name, i).second) continue;
    complaints.add(place_of(*table, "name"),
                   fmt::format("two [[{}]] are called '{}'; give each its own name", list, specs[i].name));
  }
}

// Whether there is a ply that both hold.
bool hold_one_ply(const GripSpec& one, const GripSpec& other) {
  if (one.plies.empty() || other.plies.empty()) return true;
  return std::any_of(one.plies.begin(), one.plies.end(), [&](const std::string& name) {
    return std::find(other.plies.begin(), other.plies.end(), name) != other.plies.end();
  });
}

void check_grips(const Scene& scene, const toml::table& root, Complaints& complaints) {
  std::vector<std::pair<BlankEdge, const GripSpec*>> holders;  // of each edge
  for (std::size_t i = 0; i < scene.grip.size(); ++i) {
    const GripSpec& grip = scene.grip[i];
    const toml::table* table = table_at(root, "grip", i);
    if (table == nullptr) continue;
    check_one_of(*table, "[[grip]]", "edge", "box", complaints);
    if (grip.box) check_box(*grip.box, *table, "box", complaints);
    if (grip.direction && *grip.direction == std::array<double, 3>{0.0, 0.0, 0.0}) {
      complaints.add(place_of(*table, "direction"), "'direction' is zero; give it a length");
    }
    if (!grip.edge) continue;
    const auto held = std::find_if(holders.begin(), holders.end(), [&](const auto& holder) {
      return holder.first == *grip.edge && hold_one_ply(*holder.second, grip);
    });
    if (held == holders.end()) {
      holders.emplace_back(*grip.edge, &grip);
      continue;
    }
    complaints.add(place_of(*table, "edge"), fmt::format("edge '{}' is already held by grip '{}'; one grip per edge",
                                                         name_of(*grip.edge), held->second->name));
  }
}

void check_measures(const Scene& scene, const toml::table& root, Complaints& complaints) {
  for (std::size_t i = 0; i < scene.measure.size(); ++i) {
    const MeasureSpec& measure = scene.measure[i];
    const toml::table* table = table_at(root, "measure", i);
    if (table == nullptr) continue;
    check_one_of(*table, "[[measure]]", "box", "relative_box", complaints);
    if (measure.box) check_box(*measure.box, *table, "box", complaints);
    if (measure.relative_box) check_box(*measure.relative_box, *table, "relative_box", complaints);
  }
}

void check_drape(const Scene& scene, const toml::table& root, Complaints& complaints) {
  const toml::table* table = table_at(root, "drape", 0);
  if (table == nullptr || !scene.drape) return;
  const DrapeSpec& drape = *scene.drape;
  const std::array<double, 3> zero = {0.0, 0.0, 0.0};
  std::vector<std::string> names;
  for (const auto& tool : scene.tools) names.push_back(tool.name);
  if (!drape.tool.empty() && std::find(names.begin(), names.end(), drape.tool) == names.end())
    complaints.add(place_of(*table, "tool"), fmt::format("there is no [tools.{}]{}", drape.tool,
                                                         names.empty() ? "; add it" : did_you_mean(drape.tool, names)));
  if (drape.projection == zero)
    complaints.add(place_of(*table, "projection"), "'projection' is zero; give it a length");
  if (drape.warp_direction == zero)
    complaints.add(place_of(*table, "warp_direction"), "'warp_direction' is zero; give it a length");
  if (drape.seed && drape.projection != DrapeSpec{}.projection)  // an echo has the default
    complaints.add(place_of(*table, "projection"), "[drape] has both 'seed' and 'projection'; keep one");
  if (scene.frame) complaints.add(*table, "a blank in a shear frame cannot start draped; leave [drape] or [frame] out");
  for (const char* key : {"warp_curve", "weft_curve"}) {
    const auto& curve = key[1] == 'a' ? drape.warp_curve : drape.weft_curve;
    if (curve.empty()) continue;
    if (curve.size() < 2 || std::any_of(curve.begin(), curve.end(), [](const auto& p) { return p.size() != 3; }))
      complaints.add(place_of(*table, key), fmt::format("'{}' is two points [x, y, z] or more", key));
  }
}

void check_material(const std::string& name, const toml::table& table, Complaints& complaints) {
  if (is_builtin_card(name) || is_card_path(name)) return;
  complaints.add(place_of(table, "material"),
                 fmt::format("no built-in card is called '{}', and a path needs a '/' or ends in .toml{}", name,
                             did_you_mean(name, builtin_card_names())));
}

// `title` as in messages, "[blank]" or "[[ply]]".
void check_blank(const BlankSpec& blank, const toml::table& table, const char* title, Complaints& complaints) {
  const auto goes_with = [&](const char* key, bool given, BlankShape shape) {
    if (given && blank.shape != shape)
      complaints.add(place_of(table, key), fmt::format("'{}' is of no use here; it needs shape = \"{}\", not \"{}\"",
                                                       key, name_of(shape), name_of(blank.shape)));
    if (!given && blank.shape == shape)
      complaints.add(place_of(table, "shape"),
                     fmt::format("a blank of shape \"{}\" needs '{}'; add it", name_of(shape), key));
  };
  goes_with("corners", !blank.corners.empty(), BlankShape::polygon);
  goes_with("outline", !blank.outline.empty(), BlankShape::file);
  for (const auto& [key, given] : {std::pair{"outline_unit", blank.outline_unit.has_value()},
                                   std::pair{"outline_layers", !blank.outline_layers.empty()}})
    if (given && blank.shape != BlankShape::file)
      complaints.add(place_of(table, key), fmt::format("'{}' is of no use here; it needs shape = \"file\"", key));
  goes_with("arm_width", blank.arm_width.has_value(), BlankShape::cross);
  if (blank.on_roll && blank.phase != std::array<double, 2>{0.0, 0.0})
    complaints.add(place_of(table, "phase"),
                   fmt::format("{} has both 'on_roll' and 'phase'; keep one, each says where the yarns lie", title));
}

// Keys that no chosen element or law would read.
void check_model(const ModelSpec& model, const toml::table& table, Complaints& complaints) {
  const auto needs = [&](bool given, const char* key, bool served, const char* what) {
    if (given && !served)
      complaints.add(place_of(table, key), fmt::format("'{}' is of no use here; it needs {}", key, what));
  };
  // elements that are left open are taken so that they serve (mesher/automatic/elements.cpp)
  const bool beam = model.yarn_open || model.yarn == YarnElement::beam;
  const bool bending_cell = model.cell_open || model.cell != CellElement::membrane;
  needs(model.yarn_bending.has_value(), "yarn_bending", beam, "yarn = \"beam\"");
  needs(model.cell_bending.has_value(), "cell_bending", bending_cell, "cell = \"rotation-free\" or \"shell\"");
  needs(model.bending_friction.has_value(), "bending_friction", bending_cell || beam,
        "yarn = \"beam\", or cell = \"rotation-free\" or \"shell\"");
  if (model.bending_friction && (*model.bending_friction)[0] > 0.0 && !((*model.bending_friction)[1] > 0.0))
    complaints.add(place_of(table, "bending_friction"),
                   "'bending_friction' has a rise of 0; give the curvature (1/mm) over which friction rises");
  needs(model.transverse_shear.has_value(), "transverse_shear", model.cell_open || model.cell == CellElement::shell,
        "cell = \"shell\"");
  if (model.partner != SeatbeltPartner::none && !model.yarn_open && model.yarn != YarnElement::seatbelt) {
    complaints.add(place_of(table, "partner"),
                   fmt::format("'partner' is '{}', but yarn = '{}' carries compression itself; set yarn = \"seatbelt\" "
                               "or leave 'partner' out",
                               name_of(model.partner), name_of(model.yarn)));
  }
  needs(model.contact_thickness == ContactThickness::sheared, "contact_thickness",
        model.thickness == Thickness::constant_volume, "thickness = \"constant-volume\"");
  needs(model.compression_modulus.has_value(), "compression_modulus", carries_compression(model),
        "partner = \"compression\"");
  if (model.slack && model.yarn_law != YarnLaw::slack) {
    complaints.add(place_of(table, "slack"),
                   fmt::format("'slack' is {}, but yarn_law = '{}' has none; set yarn_law = \"slack\" or leave 'slack' "
                               "out",
                               *model.slack, name_of(model.yarn_law)));
  }
}

// The thickness of contact, in a [model] or [[ply]].
void check_contact_thickness(const Scene& scene, const ModelSpec& model, const toml::table& table,
                             Complaints& complaints) {
  if (model.contact_thickness != ContactThickness::sheared || !table.contains("contact_thickness")) return;
  const toml::node& place = place_of(table, "contact_thickness");
  if (scene.drape)
    complaints.add(place,
                   "a blank that starts draped lies its card's thickness off its tool, sheared or not; leave [drape] "
                   "or 'contact_thickness' out");
  if (scene.tools.empty() && scene.ply.size() < 2)
    complaints.add(place, "'contact_thickness' is of no use here: nothing touches the fabric; add a tool or a [[ply]]");
}

void check_precision(const Scene& scene, const toml::table& analysis, Complaints& complaints) {
  if (scene.analysis.precision != Precision::single_precision) return;
  const auto complain = [&](const ModelSpec& model) {
    if (has_cell_history(model.formulation))
      complaints.add(place_of(analysis, "precision"),
                     fmt::format("'precision' is single, but formulation = '{}' adds up what every step brings, which "
                                 "needs double; leave one of them out",
                                 name_of(model.formulation)));
  };
  if (scene.ply.empty()) complain(scene.model);
  for (const PlySpec& ply : scene.ply) complain(ply.model);
}

// One frame holds all plies: it has one shape, and one way to move.
void check_framed_plies(const Scene& scene, const toml::table& root, Complaints& complaints) {
  if (const toml::table* table = table_at(root, "frame", 0); table != nullptr && !scene.frame->rigid)
    complaints.add(
        *table, "members that stretch hold one ply; set rigid = true for a stack in the frame, or leave [[ply]] out");
  const PlySpec& lowest = scene.ply.front();
  const auto place = [&](const PlySpec& ply) { return ply.position.value_or(scene.blank.position); };
  for (std::size_t k = 1; k < scene.ply.size(); ++k) {
    const PlySpec& ply = scene.ply[k];
    const toml::table* table = table_at(root, "ply", k);
    if (table == nullptr) continue;
    if (ply.blank.size != lowest.blank.size || ply.blank.orientation != lowest.blank.orientation ||
        place(ply)[0] != place(lowest)[0] || place(ply)[1] != place(lowest)[1])
      complaints.add(*table, fmt::format("ply '{}' does not lie in the frame as '{}' does; give both the same size, "
                                         "orientation and x, y of position",
                                         ply.name, lowest.name));
  }
}

constexpr std::size_t most_plies = 100;

// What each ply has of fabric, blank and model is checked like those tables themselves.
void check_plies(const Scene& scene, const toml::table& root, Complaints& complaints) {
  check_names(scene.ply, root, "ply", complaints);
  for (std::size_t k = 0; k < scene.ply.size(); ++k) {
    const toml::table* table = table_at(root, "ply", k);
    if (table == nullptr) continue;
    const PlySpec& ply = scene.ply[k];
    check_material(ply.fabric.material, *table, complaints);
    check_blank(ply.blank, *table, "[[ply]]", complaints);
    check_model(ply.model, *table, complaints);
    check_contact_thickness(scene, ply.model, *table, complaints);
  }
  if (scene.ply.empty()) return;
  if (scene.ply.size() > most_plies)
    complaints.add(*table_at(root, "ply", most_plies),
                   fmt::format("{} plies; a stack has {} at most", scene.ply.size(), most_plies));
  if (scene.frame) check_framed_plies(scene, root, complaints);
}

std::vector<std::string> ply_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const PlySpec& ply : scene.ply) names.push_back(ply.name);
  return names;
}

// A name in `key` of a table that is to be that of a ply.
void check_ply_name(const std::string& name, const std::vector<std::string>& plies, const toml::table& table,
                    const char* key, Complaints& complaints) {
  if (name.empty() || std::find(plies.begin(), plies.end(), name) != plies.end()) return;
  complaints.add(place_of(table, key), fmt::format("'{}' names '{}', and there is no such [[ply]]{}", key, name,
                                                   plies.empty() ? "; the scene has none" : did_you_mean(name, plies)));
}

void check_pairs(const Scene& scene, const toml::table& stack, Complaints& complaints) {
  const std::vector<std::string> plies = ply_names(scene);
  std::vector<std::vector<std::string>> seen;
  for (std::size_t k = 0; k < scene.stack.pair.size(); ++k) {
    const toml::table* table = table_at(stack, "pair", k);
    if (table == nullptr || !table->contains("plies")) continue;
    std::vector<std::string> names = scene.stack.pair[k].plies;
    for (const std::string& name : names) check_ply_name(name, plies, *table, "plies", complaints);
    if (names.empty()) continue;  // complained of already
    if (names.size() != 2) {
      complaints.add(place_of(*table, "plies"), fmt::format("'plies' has {} names; it must be 2", names.size()));
      continue;
    }
    std::sort(names.begin(), names.end());
    if (std::find(seen.begin(), seen.end(), names) != seen.end())
      complaints.add(place_of(*table, "plies"),
                     fmt::format("two [[stack.pair]] are of '{}' and '{}'; keep one", names[0], names[1]));
    seen.push_back(std::move(names));
  }
}

void check_stack(const Scene& scene, const toml::table& root, Complaints& complaints) {
  if (const toml::table* stack = table_at(root, "stack", 0)) {
    if (scene.ply.empty())
      complaints.add(*stack, "[stack] is of no use without plies; add a [[ply]] for each, or leave it out");
    else
      check_pairs(scene, *stack, complaints);
  }
  const std::vector<std::string> plies = ply_names(scene);
  for (std::size_t k = 0; k < scene.grip.size(); ++k)
    if (const toml::table* table = table_at(root, "grip", k))
      for (const std::string& name : scene.grip[k].plies) check_ply_name(name, plies, *table, "plies", complaints);
  for (std::size_t k = 0; k < scene.measure.size(); ++k)
    if (const toml::table* table = table_at(root, "measure", k))
      check_ply_name(scene.measure[k].ply, plies, *table, "ply", complaints);
}

}  // namespace

void check_scene(const Scene& scene, const toml::table& root, Complaints& complaints) {
  if (const toml::table* table = table_at(root, "fabric", 0)) check_material(scene.fabric.material, *table, complaints);
  check_names(scene.grip, root, "grip", complaints);
  check_names(scene.measure, root, "measure", complaints);
  if (const toml::table* table = table_at(root, "blank", 0)) check_blank(scene.blank, *table, "[blank]", complaints);
  check_grips(scene, root, complaints);
  if (const toml::table* table = table_at(root, "model", 0)) {
    check_model(scene.model, *table, complaints);
    check_contact_thickness(scene, scene.model, *table, complaints);
  }
  check_plies(scene, root, complaints);
  check_stack(scene, root, complaints);
  check_measures(scene, root, complaints);
  check_tools(scene, root, complaints);
  check_drape(scene, root, complaints);
  const toml::table* analysis = table_at(root, "analysis", 0);
  if (analysis != nullptr) check_precision(scene, *analysis, complaints);
  if (analysis != nullptr && scene.analysis.duration && scene.analysis.loading_speed) {
    complaints.add(place_of(*analysis, "loading_speed"),
                   "[analysis] has both 'duration' and 'loading_speed'; keep one, each follows from the other");
  }
}

}  // namespace weaveform
