// weaveform export SCENE|DIR: the mesh for other codes, or a formed folder's fibre directions for structural analysis.
#include "mesher/export/export.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/result_folder.hpp"
#include "app/stages.hpp"
#include "app/version.hpp"
#include "mesher/base/files.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "post/transfer/fibre_field.hpp"
#include "post/transfer/write_fibre.hpp"
#include "solver/motion/loading.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

const std::map<std::string, MeshFormat> mesh_formats = {{"abaqus", MeshFormat::abaqus},
                                                        {"calculix", MeshFormat::calculix},
                                                        {"lsdyna", MeshFormat::lsdyna},
                                                        {"openradioss", MeshFormat::openradioss},
                                                        {"gmsh", MeshFormat::gmsh}};
const std::vector<std::string> fibre_formats = {"orientation-abaqus", "drape-openradioss", "csv", "vtu"};

struct ExportArguments {
  std::string from;  // scene file or folder
  std::vector<std::string> overrides;
  std::string format;
  std::string output;
  std::string onto;
  std::string materials;  // "" for the format's own
  bool is_static = false;
  bool force = false, quiet = false, yes = false;
};

Model model_of(const ExportArguments& arguments) {
  if (!fs::is_directory(arguments.from)) return build_model(arguments.from, arguments.overrides, arguments.yes);
  if (!arguments.overrides.empty())
    throw InputError("--set changes a scene, and a folder's mesh is made; export the scene file instead");
  Model model;
  model.scene = read_scene(fs::path(arguments.from) / "scene.toml");
  model.card = load_card(model.scene.fabric.material, model.scene.file);
  model.mesh = read_mesh(fs::path(arguments.from) / "mesh.vtu");
  return model;
}

// What the command reads.
std::vector<fs::path> files_read(const ExportArguments& arguments, const Scene& scene) {
  std::vector<fs::path> files = input_files(scene);
  if (!arguments.onto.empty()) files.emplace_back(arguments.onto);
  if (!fs::is_directory(arguments.from)) return files;
  for (const char* name : {"mesh.vtu", "result.pvd", "history.csv"}) files.push_back(fs::path(arguments.from) / name);
  if (fs::is_directory(fs::path(arguments.from) / "frames"))
    for (const auto& entry : fs::directory_iterator(fs::path(arguments.from) / "frames")) files.push_back(entry.path());
  return files;
}

void log_not_carried(const ExportArguments& arguments, const std::vector<std::string>& lines) {
  if (arguments.quiet) return;
  for (const auto& line : lines) log_line("not carried: " + line);
}

// The starter's file is NAME_0000.rad and the engine's NAME_0001.rad; both programs find each other's files by NAME.
std::string run_name_of(const fs::path& output) {
  std::string name = output.stem().string();
  const std::string ending = "_0000";
  if (name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0)
    name.resize(name.size() - ending.size());
  return name;
}

void export_the_mesh(const ExportArguments& arguments, MeshFormat format) {
  if (!arguments.onto.empty())
    throw InputError("--onto maps a formed result; it goes with orientation-abaqus, drape-openradioss, csv and vtu");
  if (arguments.materials == "built-in" && format != MeshFormat::lsdyna && format != MeshFormat::openradioss &&
      format != MeshFormat::calculix)
    throw InputError(fmt::format("--materials built-in goes with lsdyna, openradioss and calculix; --format {} {}",
                                 arguments.format,
                                 format == MeshFormat::gmsh ? "has no materials" : "takes user materials"));
  const Model model = model_of(arguments);
  require_writable(arguments.output, files_read(arguments, model.scene), arguments.force);
  const double duration = choose_loading(model.scene, model.card).duration;
  ExportOptions options;
  options.materials = arguments.materials == "user" ? Materials::user : Materials::built_in;
  options.is_static = arguments.is_static;
  options.run_name = run_name_of(arguments.output);
  const ExportedMesh file = export_mesh(format, model.scene, model.card, model.mesh, duration, version_line(), options);
  std::string written = arguments.output;
  if (!file.engine.empty()) {
    const fs::path engine = fs::path(arguments.output).parent_path() / (options.run_name + "_0001.rad");
    require_writable(engine, files_read(arguments, model.scene), arguments.force);
    write_text_whole(engine, file.engine);
    written += " and " + engine.string();
  }
  write_text_whole(arguments.output, file.text);
  log_not_carried(arguments, file.not_carried);
  if (!arguments.quiet) print_answer(fmt::format("{}: {}", written, describe(model)));
}

void export_fibres(const ExportArguments& arguments) {
  if (arguments.is_static || !arguments.materials.empty())
    throw InputError(
        fmt::format("--static and --materials go with the formats of a mesh, not with {}", arguments.format));
  if (!fs::is_directory(arguments.from))
    throw InputError(fmt::format("{}: --format {} needs the folder of a solved scene ('weaveform run SCENE')",
                                 arguments.from, arguments.format));
  // in both of the formats that have no place for a comment
  require_writable(arguments.output, files_read(arguments, scene_of(arguments.from)), arguments.force,
                   arguments.format == "csv"   ? "thickness_mm,fibre_volume_ratio,"
                   : arguments.format == "vtu" ? "Name=\"fibre_volume_ratio\""
                                               : "");
  FibreField field = read_fibre_field(arguments.from);
  if (!arguments.onto.empty()) field = map_onto(field, read_structural_mesh(arguments.onto));
  if (arguments.format == "vtu") {
    write_fibre_vtu(field, arguments.output);
  } else {
    const FibreText file = arguments.format == "csv"                  ? fibre_csv(field)
                           : arguments.format == "orientation-abaqus" ? orientation_abaqus(field, version_line())
                                                                      : drape_openradioss(field, version_line());
    write_text_whole(arguments.output, file.text);
    log_not_carried(arguments, file.not_carried);
  }
  if (arguments.quiet) return;
  std::string answer = fmt::format("{}: {} shells", arguments.output, field.element.size());
  if (!arguments.onto.empty())
    answer += fmt::format("; distance from the formed fabric: greatest {:.4g} mm, mean {:.4g} mm",
                          field.greatest_distance, field.mean_distance);
  print_answer(answer);
}

void run_export(const ExportArguments& arguments) {
  const auto mesh = mesh_formats.find(arguments.format);
  if (mesh != mesh_formats.end())
    export_the_mesh(arguments, mesh->second);
  else
    export_fibres(arguments);
}

}  // namespace

void add_export_command(CLI::App& program) {
  auto* command = program.add_subcommand(
      "export", "The mesh of a scene for other codes, or a formed result's fibre directions for structural analysis");
  const auto arguments = std::make_shared<ExportArguments>();
  add_trust_argument(*command);
  command->add_option("FROM", arguments->from, "Scene file, or the folder of a meshed or solved scene")->required();
  std::vector<std::string> formats = fibre_formats;
  for (const auto& [name, format] : mesh_formats) formats.push_back(name);
  command
      ->add_option(
          "--format", arguments->format,
          "Mesh: abaqus, calculix, lsdyna, openradioss, gmsh. Formed result: orientation-abaqus, drape-openradioss, "
          "csv, vtu")
      ->required()
      ->check(CLI::IsMember(formats));
  command->add_option("-o,--output", arguments->output, "File to write")->required()->type_name("FILE");
  command->add_option("--onto", arguments->onto, "Structural shell mesh to map onto (.inp, .msh, .vtu)")
      ->type_name("FILE");
  command
      ->add_option("--materials", arguments->materials,
                   "lsdyna, openradioss: built-in (what the code has itself) or user (constants of a user material)")
      ->type_name("WHOSE")
      ->check(CLI::IsMember({"built-in", "user"}));
  command->add_flag("--static", arguments->is_static, "calculix: *STATIC instead of *DYNAMIC; a plane scene");
  command
      ->add_option("--set", arguments->overrides,
                   "Override a value of the scene, e.g. --set blank.coarsening=2; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_force_argument(*command, arguments->force);
  add_quiet_argument(*command, arguments->quiet);
  add_yes_argument(*command, arguments->yes);
  command->callback([arguments] { run_export(*arguments); });
}

}  // namespace weaveform
