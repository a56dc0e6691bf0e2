// weaveform mesh SCENE: the yarn lattice and its cells, as DIR/mesh.vtu beside the complete scene.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/checked_model.hpp"
#include "app/stages/chosen_duration.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/mesh_json.hpp"
#include "app/stages/plan.hpp"
#include "app/stages/stages.hpp"
#include "core/json/json_text.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/expected_waves.hpp"

namespace weaveform {

namespace {

struct MeshArguments {
  SceneArguments scene;
  std::string output;
  bool quiet = false, verbose = false;
  bool plan = false, json = false;
  int threads = 0;
};

void make_mesh(const MeshArguments& arguments) {
  if (arguments.plan) {
    if (!arguments.quiet) log_lines(taken_lines(read_taken_scene(arguments.scene.scene, arguments.scene.overrides)));
    const auto plan = make_plan(arguments.scene.scene, arguments.scene.overrides, arguments.threads);
    return print_answer(arguments.json ? json_text(plan_json(plan)) : plan_table(plan));
  }
  Resolved model =
      checked_model(arguments.scene.scene, arguments.scene.overrides, arguments.scene.yes, Look::for_first_complaint);
  set_duration(model, choose_duration(arguments.scene.scene, arguments.scene.overrides));
  const std::filesystem::path directory =
      arguments.output.empty() ? default_result_folder(arguments.scene.scene) : std::filesystem::path(arguments.output);
  if (!arguments.quiet) log_start("mesh", model.scene, arguments.verbose);
  const OutputFolder folder(result_claim(directory, model.scene));
  log_warning(folder.trouble());
  log_warnings(warnings_before(model));
  (void)write_model(model, directory, console_listener(arguments.quiet));
  if (arguments.quiet) return;
  log_lines(taken_lines(model.scene));
  print_answer(arguments.json ? json_text(mesh_json(model)) : describe(model));
  log_end(directory, fmt::format("mesh.vtu for ParaView; next: weaveform solve {}", directory.string()));
}

}  // namespace

void add_mesh_command(CLI::App& program) {
  auto* command = program.add_subcommand("mesh", "Build the mesh of a scene: DIR/mesh.vtu and DIR/scene.toml");
  const auto arguments = std::make_shared<MeshArguments>();
  add_scene_arguments(*command, arguments->scene);
  add_output_argument(*command, arguments->output);
  add_quiet_argument(*command, arguments->quiet);
  add_verbose_argument(*command, arguments->verbose);
  add_json_argument(*command, arguments->json);
  command->add_flag("--plan", arguments->plan,
                    "Only say what each coarsening would take: cells, yarn, step, steps, time and memory");
  command->add_option("--threads", arguments->threads, "Threads of the plan's trials; 0 chooses");
  command->callback([arguments] { make_mesh(*arguments); });
}

}  // namespace weaveform
