// weaveform drape SCENE: the blank draped on its tool, as a result in itself; no mechanics.
#include "mesher/drape/drape.hpp"

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/checked_model.hpp"
#include "app/stages/claims.hpp"
#include "core/error.hpp"
#include "core/json/json_text.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "mesher/scene/taken.hpp"
#include "post/output/drape_result.hpp"

namespace weaveform {

namespace {

struct DrapeArguments {
  SceneArguments scene;
  std::string output;
  bool quiet = false, verbose = false, json = false;
};

void make_drape(const DrapeArguments& arguments) {
  const Resolved model = checked_model(arguments.scene.scene, arguments.scene.overrides, arguments.scene.yes,
                                       Look::for_first_complaint, ResolveTo::flat);
  const Scene& scene = model.scene;
  if (!scene.ply.empty())
    throw InputError(scene.file +
                     ": 'drape' lays one blank; a stack starts draped in 'mesh', 'solve' and 'run', each ply off those "
                     "between it and the tool; leave [[ply]] out to see one net by itself");
  if (!scene.drape) throw InputError(scene.file + ": no [drape] table; add one with tool = \"NAME\"");
  const std::filesystem::path directory =
      arguments.output.empty() ? default_result_folder(arguments.scene.scene) : std::filesystem::path(arguments.output);
  if (!arguments.quiet) {
    log_start("drape", scene, arguments.verbose);
    log_lines(taken_lines(scene));
  }
  const OutputFolder folder(result_claim(directory, scene));
  log_warning(folder.trouble());
  const Drape drape = drape_blank(scene, model.mesh, model.tools);
  clear_folder(directory, scene);
  write_scene_copy(with_absolute_paths(scene), directory);
  const auto json = write_drape(scene, model.mesh, model.card, model.tools, drape, directory);
  log_warnings(drape_warnings(model.mesh, model.card, drape));
  if (arguments.quiet) return;
  print_answer(arguments.json ? json_text(json) : describe_drape(model.mesh, model.card, drape));
  log_end(directory, "drape.vtu for ParaView, flat_pattern.csv for the cutter, the numbers in drape.json");
}

}  // namespace

void add_drape_command(CLI::App& program) {
  auto* command = program.add_subcommand(
      "drape", "Drape the blank of a scene on its tool: DIR/drape.vtu, flat_pattern.csv, drape.json");
  const auto arguments = std::make_shared<DrapeArguments>();
  add_scene_arguments(*command, arguments->scene);
  add_output_argument(*command, arguments->output);
  add_quiet_argument(*command, arguments->quiet);
  add_verbose_argument(*command, arguments->verbose);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { make_drape(*arguments); });
}

}  // namespace weaveform
