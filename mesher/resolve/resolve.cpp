#include "mesher/resolve/resolve.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/automatic/take.hpp"
#include "mesher/drape/drape.hpp"
#include "mesher/lattice/build.hpp"
#include "mesher/resolve/stack.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

void require_file_of(const Scene& scene, const std::string& key, const fs::path& file) {
  if (fs::exists(file)) return;
  throw FileError(fmt::format("{}: {}: {}: no such file; correct the path, which is taken from the scene's folder",
                              scene.file, key, file.string()));
}

// Takes out of `scene` the tools whose files are not there, about which nothing more can be said.
void look_at_tool_files(Scene& scene, Findings& found) {
  std::vector<ToolSpec> there;
  for (const ToolSpec& tool : scene.tools) {
    const auto look = [&] {
      if (!tool.file.empty()) require_file_of(scene, "tools." + tool.name + ".file", tool_path(tool.file, scene.file));
    };
    if (found.attempt(look)) there.push_back(tool);
  }
  scene.tools = std::move(there);
}

bool has_outline_file(const Scene& scene, Findings& found) {
  return scene.blank.outline.empty() || found.attempt([&] {
    require_file_of(scene, "blank.outline", fs::path(scene.file).parent_path() / scene.blank.outline);
  });
}

// The tools that can be made; the others leave the scene too.
void make_what_can_be_made(Resolved& model, Findings& found) {
  std::vector<ToolSpec> made;
  for (const ToolSpec& spec : model.scene.tools)
    if (found.attempt([&] { model.tools.push_back(make_tool(spec, model.scene, model.mesh)); })) made.push_back(spec);
  model.scene.tools = std::move(made);
}

bool has_tool(const Scene& scene, const std::string& name) {
  return std::any_of(scene.tools.begin(), scene.tools.end(), [&](const ToolSpec& tool) { return tool.name == name; });
}

void drape_and_mirror(Resolved& model, Findings& found) {
  const bool draped = !model.scene.drape || (has_tool(model.scene, model.scene.drape->tool) && found.attempt([&] {
    lay_drape(model.scene, drape_blank(model.scene, model.mesh, model.tools), model.mesh);
  }));
  if (draped &&
      found.attempt([&] { model.symmetry = find_symmetry(model.scene, model.card, model.mesh, model.tools); }))
    return;
  model.mesh = {};  // nothing can be run of it
}

}  // namespace

Resolved resolve(const fs::path& scene_file, const std::vector<std::string>& overrides, Findings& found,
                 const ResolveChecks& checks, ResolveTo to) {
  Resolved model;
  model.scene = read_scene(scene_file, overrides);
  look_at_tool_files(model.scene, found);
  if (!model.scene.ply.empty()) {
    resolve_stack(model, found, checks, to);
    return model;
  }
  const bool outlined = has_outline_file(model.scene, found);
  const bool carded = found.attempt([&] { model.card = load_card(model.scene.fabric.material, model.scene.file); });
  const bool taken = outlined && carded && found.attempt([&] {
    model.outline = read_blank_outline(model.scene);
    take_what_is_open(model.scene, model.card, model.outline);
  });
  if (carded && checks.of_card) found.attempt([&] { checks.of_card(model.scene, model.card); });
  const bool meshed = taken && found.attempt([&] {
    if (checks.of_size) checks.of_size(model.scene, model.card, model.outline);
    model.mesh = build_flat_mesh(model.scene, model.card, model.outline);
  });
  if (!meshed) return model;
  make_what_can_be_made(model, found);
  if (to == ResolveTo::whole) drape_and_mirror(model, found);
  return model;
}

Resolved resolve_around(Scene scene, Card card, Mesh mesh) {
  Resolved model{std::move(scene), std::move(card), {}, {}, std::move(mesh), {}};
  if (!model.scene.ply.empty()) {
    resolve_stack_around(model);
    return model;
  }
  model.outline = read_blank_outline(model.scene);
  model.tools = make_tools(model.scene, model.mesh);
  model.symmetry = find_symmetry(model.scene, model.card, model.mesh, model.tools);
  return model;
}

Resolved without_perturbation(const Resolved& model) {
  Resolved clean = model;
  if (model.scene.analysis.perturbation == 0.0) return clean;
  clean.scene.analysis.perturbation = 0.0;
  for (Resolved& ply : clean.ply) ply.scene.analysis.perturbation = 0.0;
  if (!clean.ply.empty()) {
    mirror_stack(clean);
    return clean;
  }
  clean.symmetry = find_symmetry(clean.scene, clean.card, clean.mesh, clean.tools);
  return clean;
}

}  // namespace weaveform
