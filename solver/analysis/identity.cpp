#include "solver/analysis/identity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/files/digest.hpp"
#include "core/files/files.hpp"
#include "mesher/scene/values.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

// They change no bit of a history or frame.
constexpr std::array free_keys = {"output.contour_step", "output.checkpoint_minutes", "analysis.energy_limit"};

// Of the places of files, whose contents count.
bool is_place(const std::string& key) {
  return key == "blank.outline" || key == "fabric.material" || (key.starts_with("tools.") && key.ends_with(".file")) ||
         (key.starts_with("ply.") && (key.ends_with(".outline") || key.ends_with(".material"))) ||
         (key.starts_with("stack.") && (key.ends_with(".friction_law") || key.ends_with(".compaction")));
}

// A run can go on when its outline is gone, for its mesh is there.
std::string file_digest(const fs::path& file) {
  return fs::exists(file) ? digest_of(read_text_file(file)) : "";
}

IdentityItem file_item(const std::string& what, const fs::path& file) {
  return {what + " " + file.filename().string(), file_digest(file), true};
}

}  // namespace

Identity scene_identity(const Scene& scene) {
  Identity identity;
  for (auto& [key, value] : scene_values(scene))
    if (!is_place(key) && !key.starts_with("taken.") &&
        std::find(free_keys.begin(), free_keys.end(), key) == free_keys.end())
      identity.push_back({key, value});
  return identity;
}

std::string mesh_digest(const Mesh& mesh) {
  Digest digest;
  digest.add(mesh.nodes.position);
  digest.add(mesh.nodes.flat_position);
  digest.add(mesh.nodes.mass);
  digest.add(mesh.nodes.crossing);
  digest.add(mesh.yarns.node);
  digest.add(mesh.yarns.family);
  for (const auto* values : {&mesh.yarns.rest_length, &mesh.yarns.section, &mesh.yarns.yarns, &mesh.yarns.jaw,
                             &mesh.yarns.softening, &mesh.cells.area})
    digest.add(*values);
  digest.add(mesh.cells.offset);
  digest.add(mesh.cells.node);
  digest.add(mesh.cells.coefficient);
  digest.add(mesh.cells.lattice);
  for (const auto& tie : mesh.tie) {
    digest.add(tie.node);
    digest.add(tie.to);
    digest.add(tie.share);
  }
  digest.add(mesh.frame.corner);
  for (const auto& set : mesh.sets) {
    digest.add(set.name);
    digest.add(set.node);
  }
  digest.add(mesh.spacing);
  digest.add(mesh.lattice_size);
  digest.add(mesh.thickness);
  for (const auto& ply : mesh.ply) {
    digest.add(ply.name);
    digest.add(ply.spacing);
    digest.add(ply.lattice_size);
    digest.add(ply.thickness);
    for (const int first : {ply.first_node, ply.first_yarn, ply.first_cell, ply.first_tie, ply.first_row})
      digest.add(static_cast<double>(first));
  }
  return digest.hex();
}

Identity identity_of(const Resolved& model, const std::string& program) {
  const Scene& scene = model.scene;
  Identity identity = {{"program", program}};
  const Identity values = scene_identity(scene);
  identity.insert(identity.end(), values.begin(), values.end());
  for (std::size_t k = 0; k < model.plies(); ++k)
    identity.push_back({name_before(model, k) + "card " + model.of_ply(k).card.name,
                        digest_of(card_to_toml(model.of_ply(k).card)), true});
  for (const auto& tool : scene.tools)
    if (!tool.file.empty()) identity.push_back(file_item("tool file", tool_path(tool.file, scene.file)));
  for (const Tool& tool : model.tools)
    if (!tool.surface_digest.empty()) identity.push_back({"surface of tool " + tool.name, tool.surface_digest, true});
  for (std::size_t k = 0; k < model.plies(); ++k)
    if (const std::string& outline = model.of_ply(k).scene.blank.outline; !outline.empty())
      identity.push_back(
          file_item(name_before(model, k) + "outline file", fs::path(scene.file).parent_path() / outline));
  for (const std::string& file : law_files(scene)) identity.push_back(file_item("law file", file));
  identity.push_back({"mesh", mesh_digest(model.mesh), true});
  return identity;
}

std::vector<std::string> differences(const Identity& older, const Identity& now, const std::string& there) {
  const auto find = [](const Identity& items, const std::string& name) {
    return std::find_if(items.begin(), items.end(), [&](const IdentityItem& item) { return item.name == name; });
  };
  std::vector<std::string> lines;
  for (const auto& item : older) {
    const auto found = find(now, item.name);
    const bool content = item.content && found != now.end();
    const bool unknown = content && (item.value.empty() || found->value.empty());
    if (unknown || (found != now.end() && found->value == item.value)) continue;
    if (content)
      lines.push_back(item.name + ": content differs");
    else if (item.content)
      lines.push_back(fmt::format("{}: in {}, not now", item.name, there));
    else
      lines.push_back(fmt::format("{}: {} in {}, {} now", item.name, item.value, there,
                                  found == now.end() ? "none" : found->value));
  }
  for (const auto& item : now)
    if (find(older, item.name) == older.end())
      lines.push_back(item.content ? fmt::format("{}: not in {}", item.name, there)
                                   : fmt::format("{}: none in {}, {} now", item.name, there, item.value));
  return lines;
}

std::string digest_of(const Identity& identity) {
  Digest digest;
  for (const auto& item : identity) {
    if (item.name == "program") continue;
    digest.add(item.name);
    digest.add(item.value);
  }
  return digest.hex();
}

}  // namespace weaveform
