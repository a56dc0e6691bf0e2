// weaveform drape SCENE: the blank, or each ply of a stack, draped on its tool, as a result in itself; no mechanics.
#include "mesher/drape/drape.hpp"

#include <fmt/format.h>

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
#include "mesher/resolve/drape_stack.hpp"
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

// Of one blank, or of each ply of a stack.
std::vector<DrapedPly> drape_all(const Resolved& model) {
  if (!model.ply.empty()) return drape_plies(model);
  return {{.off = 0.0, .tools = model.tools, .drape = drape_blank(model.scene, model.mesh, model.tools)}};
}

std::vector<DrapedBlank> blanks_of(const Resolved& model, const std::vector<DrapedPly>& laid) {
  std::vector<DrapedBlank> blanks;
  for (std::size_t k = 0; k < model.plies(); ++k) {
    const Resolved& ply = model.of_ply(k);
    blanks.push_back({.ply = model.ply.empty() ? "" : model.scene.ply[k].name,
                      .scene = ply.scene,
                      .mesh = ply.mesh,
                      .card = ply.card,
                      .tools = laid[k].tools,
                      .drape = laid[k].drape,
                      .off_tool = laid[k].off});
  }
  return blanks;
}

void make_drape(const DrapeArguments& arguments) {
  const Resolved model = checked_model(arguments.scene.scene, arguments.scene.overrides, arguments.scene.yes,
                                       Look::for_first_complaint, ResolveTo::flat);
  const Scene& scene = model.scene;
  if (!scene.drape) throw InputError(scene.file + ": no [drape] table; add one with tool = \"NAME\"");
  const std::filesystem::path directory =
      arguments.output.empty() ? default_result_folder(arguments.scene.scene) : std::filesystem::path(arguments.output);
  if (!arguments.quiet) {
    log_start("drape", scene, arguments.verbose);
    log_lines(taken_lines(scene));
  }
  const OutputFolder folder(result_claim(directory, scene));
  log_warning(folder.trouble());
  const std::vector<DrapedPly> laid = drape_all(model);
  const std::vector<DrapedBlank> blanks = blanks_of(model, laid);
  clear_folder(directory, scene);
  write_scene_copy(with_absolute_paths(scene), directory);
  const auto json = write_drape(blanks, directory);
  log_warnings(drape_warnings(blanks));
  if (arguments.quiet) return;
  print_answer(arguments.json ? json_text(json) : describe_drape(blanks));
  log_end(directory, fmt::format("drape.vtu for ParaView, {}flat_pattern.csv for the cutter, the numbers in drape.json",
                                 scene.ply.empty() ? "" : "plies/NAME/"));
}

}  // namespace

void add_drape_command(CLI::App& program) {
  auto* command = program.add_subcommand(
      "drape", "Drape the blank or the plies of a scene on their tool: DIR/drape.vtu, flat_pattern.csv, drape.json");
  const auto arguments = std::make_shared<DrapeArguments>();
  add_scene_arguments(*command, arguments->scene);
  add_output_argument(*command, arguments->output);
  add_quiet_argument(*command, arguments->quiet);
  add_verbose_argument(*command, arguments->verbose);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { make_drape(*arguments); });
}

}  // namespace weaveform
