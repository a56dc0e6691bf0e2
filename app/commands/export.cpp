// weaveform export SCENE|DIR: the mesh for other codes, or a formed folder's fibre directions for structural analysis.
#include "mesher/exchange/export.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/checked_model.hpp"
#include "app/stages/chosen_duration.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/mesh_json.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "core/keys/length_unit.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/version/version.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "post/transfer/fibre_field.hpp"
#include "post/transfer/layered.hpp"
#include "post/transfer/write_fibre.hpp"
#include "solver/analysis/loading.hpp"
#include "solver/result/file_names.hpp"
#include "solver/result/result_folder.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

constexpr double usual_group_angle = 1.0;  // deg

struct ExportArguments {
  std::string from;  // scene file or folder
  std::vector<std::string> overrides;
  std::string format;
  std::string output;
  std::string onto, part, unit;  // part and unit of the mesh to map onto
  std::vector<double> position, rotation;
  std::optional<double> within, group_angle;
  std::string materials;  // of Materials; "" for the format's own
  std::string ply;        // of a stack; "": all of them
  bool is_static = false;
  bool force = false, quiet = false, yes = false, json = false;
};

Resolved model_of(const ExportArguments& arguments) {
  if (!fs::is_directory(arguments.from))
    return checked_model(arguments.from, arguments.overrides, arguments.yes, Look::for_first_complaint);
  if (!arguments.overrides.empty())
    throw InputError("--set changes a scene, and a folder's mesh is made; export the scene file instead");
  return ResultFolder(arguments.from).model();
}

// Of a stack the number of the ply asked for; none: all.
std::optional<std::size_t> ply_asked(const ExportArguments& arguments, const Resolved& model) {
  if (arguments.ply.empty()) return {};
  std::vector<std::string> names;
  for (std::size_t k = 0; k < model.ply.size(); ++k) {
    names.push_back(model.mesh.ply[k].name);
    if (names.back() == arguments.ply) return k;
  }
  throw InputError(fmt::format("--ply {}: no such [[ply]]{}", arguments.ply,
                               names.empty() ? "; the scene has none" : did_you_mean(arguments.ply, names)));
}

// The one ply that goes into a mesh for another code.
Resolved one_ply_of(Resolved model, const ExportArguments& arguments) {
  const auto asked = ply_asked(arguments, model);
  if (model.ply.empty()) return model;
  std::vector<std::string> names;
  for (const MeshPly& ply : model.mesh.ply) names.push_back(ply.name);
  if (!asked && model.ply.size() > 1)
    throw InputError(
        fmt::format("--format {} takes one ply of a stack, without what the others do to it; say with --ply "
                    "which: {}",
                    arguments.format, fmt::join(names, ", ")));
  Resolved one = std::move(model.ply[asked.value_or(0)]);
  one.mesh.first_shown = 0;
  return one;
}

// What the command reads.
std::vector<fs::path> files_read(const ExportArguments& arguments, const Scene& scene) {
  std::vector<fs::path> files = input_files(scene);
  if (!arguments.onto.empty()) files.emplace_back(arguments.onto);
  if (!fs::is_directory(arguments.from)) return files;
  for (const auto& file : present_files(arguments.from, joined({{file_name::mesh}, solve_files()})))
    files.push_back(file);
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
    throw InputError(
        "--onto maps a formed result; it goes with orientation-abaqus, orientation-calculix, drape-openradioss, "
        "composite-lsdyna, "
        "csv and vtu");
  const auto materials = choice_named<Materials>(arguments.materials);
  if (materials == Materials::built_in && format != MeshFormat::lsdyna && format != MeshFormat::openradioss &&
      format != MeshFormat::calculix)
    throw InputError(fmt::format("--materials built-in goes with lsdyna, openradioss and calculix; --format {} {}",
                                 arguments.format,
                                 format == MeshFormat::gmsh ? "has no materials" : "takes user materials"));
  Resolved model = one_ply_of(model_of(arguments), arguments);
  require_writable(arguments.output, files_read(arguments, model.scene), arguments.force);
  if (!fs::is_directory(arguments.from)) {
    set_duration(model, choose_duration(arguments.from, arguments.overrides));
    if (!arguments.quiet) log_lines(taken_lines(model.scene));
  }
  const double duration = choose_loading(model).duration;
  ExportOptions options;
  options.materials = materials.value_or(Materials::built_in);
  options.is_static = arguments.is_static;
  options.run_name = run_name_of(arguments.output);
  const ExportedMesh file =
      export_mesh(format, model.scene, model.card, model.mesh, model.tools, duration, version_line(), options);
  std::vector<std::string> written = {arguments.output};
  if (!file.engine.empty()) {
    const fs::path engine = fs::path(arguments.output).parent_path() / (options.run_name + "_0001.rad");
    require_writable(engine, files_read(arguments, model.scene), arguments.force);
    write_text_whole(engine, file.engine);
    written.push_back(engine.string());
  }
  write_text_whole(arguments.output, file.text);
  log_not_carried(arguments, file.not_carried);
  if (arguments.json)
    print_answer(json_text({{"files", written}, {"mesh", mesh_json(model)}, {"not_carried", file.not_carried}}));
  else if (!arguments.quiet)
    print_answer(fmt::format("{}: {}", fmt::join(written, " and "), describe(model)));
}

// What says something of --onto alone, or of one format.
void require_use(const ExportArguments& arguments) {
  const bool given = !arguments.part.empty() || !arguments.unit.empty() || !arguments.position.empty() ||
                     !arguments.rotation.empty() || arguments.within;
  if (given && arguments.onto.empty())
    throw InputError("--part, --unit, --position, --rotation and --within go with --onto FILE");
  if (arguments.group_angle && arguments.format != name_of(FibreFormat::orientation_calculix))
    throw InputError("--group-angle goes with --format orientation-calculix");
}

Onto onto_of(const ExportArguments& arguments) {
  Onto onto;
  onto.unit = choice_named<LengthUnit>(arguments.unit);
  onto.within = arguments.within;
  if (!arguments.position.empty()) std::copy_n(arguments.position.begin(), 3, onto.position.begin());
  if (!arguments.rotation.empty()) {
    std::copy_n(arguments.rotation.begin(), 3, onto.axis.begin());
    onto.angle = arguments.rotation[3];
  }
  return onto;
}

bool is_orientation(FibreFormat format) {
  return format == FibreFormat::orientation_abaqus || format == FibreFormat::orientation_calculix;
}

FibreField mapped(const ExportArguments& arguments, FibreFormat format, const FibreField& field) {
  const ForeignMesh structure = read_structural_mesh(arguments.onto, arguments.part);
  if (is_orientation(format))
    for (const auto& shell : structure.shells)
      if (structure.instance[shell.instance].turned)
        throw InputError(
            fmt::format("{}: instance '{}' is turned in the assembly, while {} is written in the axes of its "
                        "part; map onto the part alone with --rotation, or onto a flat file",
                        arguments.onto, structure.instance[shell.instance].name, arguments.format));
  return map_onto(field, structure, onto_of(arguments));
}

void warn_of_far_shells(const std::string& onto, const FibreField& field) {
  if (field.far > 0)
    log_warning(
        fmt::format("{}: {} of {} shells lie farther than {:.4g} mm from the formed fabric, the farthest {:.4g} mm; "
                    "they get no direction (--within sets that distance)",
                    onto, field.far, field.element.size(), field.within, field.greatest_distance));
}

FibreText fibre_text(const ExportArguments& arguments, FibreFormat format, const FibreField& field) {
  if (format == FibreFormat::csv) return fibre_csv(field);
  if (format == FibreFormat::orientation_abaqus) return orientation_abaqus(field, version_line());
  if (format == FibreFormat::orientation_calculix)
    return orientation_calculix(field, arguments.group_angle.value_or(usual_group_angle), version_line());
  if (format == FibreFormat::composite_lsdyna) return layers_lsdyna({{"fabric", "fabric", field}}, version_line());
  return drape_openradioss(field, version_line());
}

std::string describe_fibres(const ExportArguments& arguments, const FibreField& field) {
  std::string answer = fmt::format("{}: {} shells", arguments.output, field.element.size());
  if (!arguments.onto.empty())
    answer += fmt::format("; distance from the formed fabric: greatest {:.4g} mm, mean {:.4g} mm{}",
                          field.greatest_distance, field.mean_distance,
                          field.far > 0
                              ? fmt::format(" of the {} within {:.4g} mm",
                                            field.element.size() - static_cast<std::size_t>(field.far), field.within)
                              : "");
  return answer;
}

nlohmann::ordered_json fibres_json(const ExportArguments& arguments, const FibreField& field,
                                   const std::vector<std::string>& not_carried) {
  nlohmann::ordered_json json = {{"files", nlohmann::ordered_json::array({arguments.output})},
                                 {"shells", field.element.size()}};
  if (!arguments.onto.empty())
    json["distance_from_fabric"] = {{"greatest_mm", field.greatest_distance},
                                    {"mean_mm", field.mean_distance},
                                    {"within_mm", field.within},
                                    {"shells_beyond", field.far}};
  json["not_carried"] = not_carried;
  return json;
}

FibreText layers_text(const ExportArguments& arguments, FibreFormat format, const std::vector<FibreLayer>& layers) {
  if (format == FibreFormat::csv) return layers_csv(layers);
  if (format == FibreFormat::orientation_abaqus) return layers_abaqus(layers, version_line());
  if (format == FibreFormat::orientation_calculix)
    return layers_calculix(layers, arguments.group_angle.value_or(usual_group_angle), version_line());
  if (format == FibreFormat::composite_lsdyna) return layers_lsdyna(layers, version_line());
  return layers_openradioss(layers, version_line());
}

// All plies of a stack: mapped onto one structural mesh, of which they are the layers, without one onto the lowest ply's
// own cells; in a table one after another.
void export_layers(const ExportArguments& arguments, FibreFormat format, ResultFolder& result) {
  if (format == FibreFormat::vtu)
    throw InputError("--format vtu holds the fibres of one ply; say with --ply which, or take csv for all");
  std::vector<FibreLayer> layers = read_fibre_layers(result);
  if (!arguments.onto.empty())
    for (FibreLayer& layer : layers) {
      layer.field = mapped(arguments, format, layer.field);
      warn_of_far_shells("ply '" + layer.ply + "': " + arguments.onto, layer.field);
    }
  else if (format != FibreFormat::csv)
    map_onto_lowest(layers);
  const FibreText file = layers_text(arguments, format, layers);
  write_text_whole(arguments.output, file.text);
  log_not_carried(arguments, file.not_carried);
  if (arguments.json) {
    nlohmann::ordered_json json = fibres_json(arguments, layers.front().field, file.not_carried);
    for (const FibreLayer& layer : layers) json["layers"].push_back({{"ply", layer.ply}, {"material", layer.material}});
    return print_answer(json_text(json));
  }
  if (!arguments.quiet)
    print_answer(fmt::format("{}, {} layers", describe_fibres(arguments, layers.front().field), layers.size()));
}

void export_fibres(const ExportArguments& arguments, FibreFormat format) {
  if (arguments.is_static || !arguments.materials.empty())
    throw InputError(
        fmt::format("--static and --materials go with the formats of a mesh, not with {}", arguments.format));
  if (!fs::is_directory(arguments.from))
    throw InputError(fmt::format("{}: --format {} needs the folder of a solved scene ('weaveform run SCENE')",
                                 arguments.from, arguments.format));
  ResultFolder result(arguments.from);
  // in both of the formats that have no place for a comment
  require_writable(arguments.output, files_read(arguments, result.scene()), arguments.force,
                   format == FibreFormat::csv   ? "thickness_mm,fibre_volume_ratio,"
                   : format == FibreFormat::vtu ? "Name=\"fibre_volume_ratio\""
                                                : "");
  if (!result.scene().ply.empty() && arguments.ply.empty()) return export_layers(arguments, format, result);
  FibreField field = arguments.ply.empty() ? read_fibre_field(result)
                                           : read_fibre_field(result, ply_asked(arguments, result.model()).value());
  std::vector<std::string> not_carried;
  if (!arguments.onto.empty()) field = mapped(arguments, format, field);
  warn_of_far_shells(arguments.onto, field);
  if (format == FibreFormat::vtu) {
    write_fibre_vtu(field, arguments.output);
  } else {
    const FibreText file = fibre_text(arguments, format, field);
    write_text_whole(arguments.output, file.text);
    not_carried = file.not_carried;
    log_not_carried(arguments, not_carried);
  }
  if (arguments.json) return print_answer(json_text(fibres_json(arguments, field, not_carried)));
  if (!arguments.quiet) print_answer(describe_fibres(arguments, field));
}

void run_export(const ExportArguments& arguments) {
  require_use(arguments);
  if (const auto mesh = choice_named<MeshFormat>(arguments.format)) export_the_mesh(arguments, *mesh);
  if (const auto fibres = choice_named<FibreFormat>(arguments.format)) export_fibres(arguments, *fibres);
}

}  // namespace

void add_export_command(CLI::App& program) {
  auto* command = program.add_subcommand(
      "export", "The mesh of a scene for other codes, or a formed result's fibre directions for structural analysis");
  const auto arguments = std::make_shared<ExportArguments>();
  add_trust_argument(*command);
  command->add_option("FROM", arguments->from, "Scene file, or the folder of a meshed or solved scene")->required();
  std::vector<std::string> formats = choice_names<FibreFormat>();
  for (const std::string& name : choice_names<MeshFormat>()) formats.push_back(name);
  std::sort(formats.begin() + choices_of(FibreFormat{}).size(), formats.end());
  command
      ->add_option("--format", arguments->format,
                   "Mesh: abaqus, calculix, lsdyna, openradioss, gmsh. Formed result: orientation-abaqus, "
                   "orientation-calculix, drape-openradioss, composite-lsdyna, csv, vtu")
      ->required()
      ->check(CLI::IsMember(formats));
  command->add_option("-o,--output", arguments->output, "File to write")->required()->type_name("FILE");
  command->add_option("--onto", arguments->onto, "Structural shell mesh to map onto (.inp, .msh, .vtu)")
      ->type_name("FILE");
  command
      ->add_option("--part", arguments->part, "Of that mesh: the part, instance or element set whose shells are meant")
      ->type_name("NAME");
  command
      ->add_option("--unit", arguments->unit,
                   "Of that mesh: mm, cm, m, inch; left out: mm, and asked about when it is then out of proportion")
      ->check(CLI::IsMember(choice_names<LengthUnit>()));
  command
      ->add_option("--rotation", arguments->rotation, "Turns that mesh about an axis through its origin: x,y,z,degrees")
      ->delimiter(',')
      ->expected(4)
      ->type_name("X,Y,Z,DEG");
  command
      ->add_option(
          "--position", arguments->position,
          "Then moves its origin to this place (mm) of the scene; what is written stays in the mesh's own axes")
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  command
      ->add_option("--within", arguments->within,
                   "Shells farther than this (mm) from the fabric get no direction (default: half the mean side of the "
                   "shells or of the fabric's cells)")
      ->check(CLI::NonNegativeNumber)
      ->type_name("MM");
  command
      ->add_option("--group-angle", arguments->group_angle,
                   "Of orientation-calculix: shells with directions within this angle share a section (default 1 deg; "
                   "0: none but equal ones)")
      ->check(CLI::Range(0.0, 45.0))
      ->type_name("DEG");
  command
      ->add_option("--materials", arguments->materials,
                   "lsdyna, openradioss: built-in (what the code has itself) or user (constants of a user material)")
      ->type_name("WHOSE")
      ->check(CLI::IsMember(choice_names<Materials>()));
  command
      ->add_option("--ply", arguments->ply,
                   "Of a stack: the ply that is meant; left out: all, where the format has layers")
      ->type_name("NAME");
  command->add_flag("--static", arguments->is_static, "calculix: *STATIC instead of *DYNAMIC; a plane scene");
  command
      ->add_option("--set", arguments->overrides,
                   "Override a value of the scene, e.g. --set blank.coarsening=2; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_force_argument(*command, arguments->force);
  add_quiet_argument(*command, arguments->quiet);
  add_yes_argument(*command, arguments->yes);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { run_export(*arguments); });
}

}  // namespace weaveform
