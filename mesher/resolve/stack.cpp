#include "mesher/resolve/stack.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/error.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/mesh/stack.hpp"
#include "mesher/resolve/drape_stack.hpp"
#include "mesher/resolve/of_ply.hpp"
#include "mesher/scene/ply_scene.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

void require_outline_file(const Scene& scene) {
  if (scene.blank.outline.empty()) return;
  const fs::path file = fs::path(scene.file).parent_path() / scene.blank.outline;
  if (!fs::exists(file))
    throw FileError(
        fmt::format("{}: outline: {}: no such file; correct the path, which is taken from the scene's folder",
                    scene.file, file.string()));
}

// Card and outline. Grips that hold whatever lies in their box leave a ply alone that has nothing there.
void read_ply(Resolved& ply) {
  require_outline_file(ply.scene);
  ply.card = load_card(ply.scene.fabric.material, ply.scene.file);
  ply.outline = read_blank_outline(ply.scene);
  std::erase_if(ply.scene.grip, [&](const GripSpec& grip) {
    return grip.plies.empty() && grip.box && lies_off(*grip.box, ply.extent());
  });
  std::erase_if(ply.scene.measure, [&](const MeasureSpec& measure) {
    return measure.ply.empty() && measure.box && lies_off(*measure.box, ply.extent());
  });
}

void read_pairs(Resolved& model) {
  const auto& plies = model.scene.ply;
  model.pair.clear();
  for (std::size_t k = 1; k < plies.size(); ++k)
    for (std::size_t i = 0; i < k; ++i) model.pair.push_back(resolve_pair(model.scene, plies[i].name, plies[k].name));
}

void place_plies(Resolved& model) {
  for (std::size_t k = 1; k < model.ply.size(); ++k)
    if (!model.scene.ply[k].position)
      model.ply[k].scene.blank.position[2] = model.ply[k - 1].scene.blank.position[2] + distance_between(model, k - 1);
}

// A grip that all plies leave alone holds nothing.
void require_grips(const Resolved& model) {
  std::vector<std::string> complaints;
  for (const GripSpec& grip : model.scene.grip) {
    const bool holds = std::any_of(model.ply.begin(), model.ply.end(), [&](const Resolved& ply) {
      return std::any_of(ply.scene.grip.begin(), ply.scene.grip.end(),
                         [&](const GripSpec& own) { return own.name == grip.name; });
    });
    if (!holds)
      complaints.push_back(fmt::format("{}: grip '{}' holds no node: no ply has fabric in its box; enlarge it",
                                       model.scene.file, grip.name));
  }
  if (!complaints.empty()) throw InputError(complaints);
}

// A tool that is laid on the blank lies on the stack's lower or upper face.
Tool stack_tool(const ToolSpec& spec, const Resolved& model) {
  const Resolved& touched = lies_below(spec) ? model.ply.front() : model.ply.back();
  return make_tool(spec, touched.scene, touched.card.thickness, cell_edge_of(model.mesh));
}

// Each ply's middle plane lies half of its own thickness off the tools.
void give_tools(Resolved& model) {
  for (Resolved& ply : model.ply) {
    ply.tools = model.tools;
    ply.scene.tools = model.scene.tools;
    for (std::size_t t = 0; t < ply.tools.size(); ++t)
      ply.tools[t].offset = offset_of(ply.scene.tools[t], ply.card.thickness);
  }
}

bool is_there(const std::vector<Tool>& tools, const std::string& name) {
  return std::any_of(tools.begin(), tools.end(), [&](const Tool& tool) { return tool.name == name; });
}

}  // namespace

double distance_between(const Resolved& model, std::size_t lower) {
  return 0.5 * (model.ply[lower].card.thickness + model.ply[lower + 1].card.thickness) +
         model.pair[pair_number(lower, lower + 1)].gap;
}

void join_plies(Resolved& model) {
  std::vector<NamedMesh> plies;
  for (std::size_t k = 0; k < model.ply.size(); ++k) plies.push_back({model.scene.ply[k].name, &model.ply[k].mesh});
  model.mesh = joined_mesh(plies);
  for (std::size_t k = 0; k < model.ply.size(); ++k) model.ply[k].mesh.first_shown = model.mesh.ply[k].first_node;
  model.card = model.ply.front().card;
  model.outline = model.ply.front().outline;
}

void mirror_stack(Resolved& model) {
  std::vector<PlyToMirror> plies;
  for (std::size_t k = 0; k < model.ply.size(); ++k)
    plies.push_back({model.scene.ply[k].name, model.ply[k].scene, model.ply[k].card, model.ply[k].mesh});
  std::vector<Symmetry> found = find_symmetry(plies, model.tools);
  for (std::size_t k = 0; k < model.ply.size(); ++k) model.ply[k].symmetry = std::move(found[k]);
  model.symmetry = model.ply.front().symmetry;
  model.symmetry.map.clear();  // each ply has its own
}

void resolve_stack(Resolved& model, Findings& found, const ResolveChecks& checks, ResolveTo to) {
  bool whole = true;
  for (std::size_t k = 0; k < model.scene.ply.size(); ++k) {
    Resolved& ply = model.ply.emplace_back();
    ply.scene = scene_of_ply(model.scene, k);
    const bool read = found.attempt([&] {
      of_ply(model, k, [&] {
        read_ply(ply);
        take_what_is_open(model.scene, k, ply.scene, ply.card, ply.outline);
      });
    });
    if (read && checks.of_card) found.attempt([&] { of_ply(model, k, [&] { checks.of_card(ply.scene, ply.card); }); });
    whole = whole && read;
  }
  whole = found.attempt([&] { read_pairs(model); }) && whole;
  if (whole) place_plies(model);
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    Resolved& ply = model.ply[k];
    if (ply.card.thickness <= 0.0) continue;  // it could not be read
    const bool meshed = found.attempt([&] {
      of_ply(model, k, [&] {
        if (checks.of_size) checks.of_size(ply.scene, ply.card, ply.outline);
        ply.mesh = build_flat_mesh(ply.scene, ply.card, ply.outline);
      });
    });
    whole = whole && meshed;
  }
  if (whole) whole = found.attempt([&] { require_grips(model); });
  if (!whole) return;
  join_plies(model);
  std::vector<ToolSpec> made;
  for (const ToolSpec& spec : model.scene.tools)
    if (found.attempt([&] { model.tools.push_back(stack_tool(spec, model)); })) made.push_back(spec);
  model.scene.tools = std::move(made);
  give_tools(model);
  if (to == ResolveTo::flat) return;
  const bool draped = !model.scene.drape ||
                      (is_there(model.tools, model.scene.drape->tool) && found.attempt([&] { drape_stack(model); }));
  if (!draped || !found.attempt([&] { mirror_stack(model); })) model.mesh = {};  // nothing can be run of it
}

void resolve_stack_around(Resolved& model) {
  const auto& plies = model.scene.ply;
  bool same = model.mesh.ply.size() == plies.size();
  for (std::size_t k = 0; k < plies.size() && same; ++k) same = model.mesh.ply[k].name == plies[k].name;
  if (!same)
    throw InputError(
        fmt::format("{}: its plies are not those of the mesh, which has {}; make the mesh again with "
                    "'weaveform mesh'",
                    model.scene.file, model.mesh.ply.empty() ? "none" : std::to_string(model.mesh.ply.size())));
  for (std::size_t k = 0; k < plies.size(); ++k) {
    Resolved& ply = model.ply.emplace_back();
    ply.scene = scene_of_ply(model.scene, k);
    of_ply(model, k, [&] { read_ply(ply); });
    ply.mesh = ply_mesh(model.mesh, k);
  }
  read_pairs(model);
  place_plies(model);
  model.card = model.ply.front().card;
  model.outline = model.ply.front().outline;
  for (const ToolSpec& spec : model.scene.tools) model.tools.push_back(stack_tool(spec, model));
  give_tools(model);
  mirror_stack(model);
}

}  // namespace weaveform
