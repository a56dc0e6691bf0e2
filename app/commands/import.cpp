// weaveform import FILE: a mesh of another code as a folder that `weaveform solve` takes.
#include "mesher/exchange/import.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/mesh_json.hpp"
#include "app/stages/stages.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "mesher/resolve/of_ply.hpp"
#include "mesher/resolve/stack.hpp"
#include "mesher/scene/ply_scene.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

constexpr double same_place = 1e-6;  // mm

struct ImportArguments {
  std::string file, scene, part, output;
  std::vector<std::string> overrides;
  bool quiet = false, json = false;
};

// Tools whose shells stand in the mesh file become STL files beside the mesh.
void keep_tools(const ForeignMesh& file, const fs::path& directory, Scene& scene) {
  for (auto& tool : scene.tools) {
    if (tool.shape != ToolShape::triangles) continue;
    const auto surface = tool_surface(file, tool.name);
    if (!surface) continue;
    const fs::path stl = fs::absolute(directory / (tool.name + ".stl"));
    write_text_whole(stl, *surface);
    tool.file = stl.string();
  }
}

// Of a stack each ply from the part of its name, where it lies in the file.
ImportedMesh import_plies(const ForeignMesh& file, Resolved& model) {
  ImportedMesh all;
  std::vector<std::string> names;
  for (const PlySpec& ply : model.scene.ply) names.push_back(ply.name);
  for (std::size_t k = 0; k < names.size(); ++k) {
    Resolved& ply = model.ply.emplace_back();
    ply.scene = scene_of_ply(model.scene, k);
    of_ply(model, k, [&] {
      ply.card = load_card(ply.scene.fabric.material, model.scene.file);
      ImportedMesh own = import_foreign(file, ply.scene, ply.card, names[k], names);
      ply.mesh = std::move(own.mesh);
      for (const std::string& note : own.notes) all.notes.push_back(fmt::format("ply '{}': {}", names[k], note));
    });
    const double z = ply.mesh.nodes.position.front()[2];
    const std::optional<std::array<double, 3>> asked = model.scene.ply[k].position;
    if (asked && std::abs((*asked)[2] - z) > same_place)
      all.notes.push_back(
          fmt::format("ply '{}': lies at z = {:.6g} mm, not at the {:.6g} mm of its 'position'; the mesh counts",
                      names[k], z, (*asked)[2]));
    ply.scene.blank.position[2] = z;
    model.scene.ply[k].position = ply.scene.blank.position;
  }
  join_plies(model);
  all.mesh = model.mesh;
  return all;
}

// What Weaveform wrote has its scene with it.
ImportedMesh import_as_written(const ImportArguments& arguments, const ForeignMesh& file, Resolved& model) {
  if (!arguments.part.empty()) throw InputError("--part goes with --scene: it names the fabric in a file of others");
  ImportedMesh imported = import_own(file);
  model.scene = read_scene_text(imported.scene, arguments.file, arguments.overrides);
  model.card = load_card(model.scene.fabric.material, model.scene.file);
  return imported;
}

ImportedMesh import_by_scene(const ImportArguments& arguments, const ForeignMesh& file, Resolved& model) {
  model.scene = read_scene(arguments.scene, arguments.overrides);
  if (leaves_open(model.scene))
    throw InputError(arguments.scene +
                     ": a mesh from elsewhere has cells of its own, which no accuracy chooses; give blank.coarsening, "
                     "model.yarn and model.cell in place of \"auto\"");
  if (model.scene.ply.empty()) {
    model.card = load_card(model.scene.fabric.material, model.scene.file);
    return import_foreign(file, model.scene, model.card, arguments.part);
  }
  if (!arguments.part.empty())
    throw InputError("--part names the one fabric in a file; the plies of a stack are the parts of their names");
  return import_plies(file, model);
}

void run_import(const ImportArguments& arguments) {
  const ForeignMesh file = read_foreign_mesh(arguments.file);
  const fs::path directory = arguments.output;
  Resolved model;
  ImportedMesh imported =
      arguments.scene.empty() ? import_as_written(arguments, file, model) : import_by_scene(arguments, file, model);
  model.mesh = std::move(imported.mesh);
  OutputClaim claim = result_claim(directory, model.scene);
  for (const auto& each : file.files) claim.inputs.push_back(each);
  for (const auto& tool : model.scene.tools) claim.names.push_back(tool.name + ".stl");
  const OutputFolder folder(claim);
  log_warning(folder.trouble());
  model.scene = with_absolute_paths(model.scene);
  keep_tools(file, directory, model.scene);
  const std::string size = describe(model);
  nlohmann::ordered_json json = mesh_json(model);
  json["notes"] = imported.notes;
  (void)write_model(std::move(model), directory, console_listener(arguments.quiet), imported.scene_name);
  if (arguments.quiet) return;
  for (const auto& note : imported.notes) log_line("import: " + note);
  print_answer(arguments.json ? json_text(json) : size);
}

}  // namespace

void add_import_command(CLI::App& program) {
  auto* command = program.add_subcommand(
      "import", "A mesh of lines and shells (Gmsh .msh, Abaqus .inp) as DIR/mesh.vtu and DIR/scene.toml");
  const auto arguments = std::make_shared<ImportArguments>();
  add_trust_argument(*command);
  command->add_option("FILE", arguments->file, "Mesh file, .msh or .inp")->required();
  command
      ->add_option("--scene", arguments->scene,
                   "Scene with fabric, model, grips (by the names of node sets), tools and analysis; not needed for "
                   "files that 'weaveform export' wrote")
      ->type_name("SCENE");
  command->add_option("--part", arguments->part, "The fabric's part or instance, where several have lines and shells")
      ->type_name("NAME");
  command->add_option("-o,--output", arguments->output, "Folder for 'weaveform solve'")->required()->type_name("DIR");
  command->add_option("--set", arguments->overrides, "Override a value of the scene; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_quiet_argument(*command, arguments->quiet);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { run_import(*arguments); });
}

}  // namespace weaveform
