// weaveform run SCENE: mesh, solve and post in one go.
#include <filesystem>
#include <memory>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/result_folder.hpp"
#include "app/stages.hpp"

namespace weaveform {

namespace {

struct RunArguments {
  SceneArguments scene;
  std::string output;
  SolveOptions solve;
};

void run(const RunArguments& arguments) {
  const Model model = build_model(arguments.scene.scene, arguments.scene.overrides);
  const std::filesystem::path directory =
      arguments.output.empty() ? default_result_folder(arguments.scene.scene) : std::filesystem::path(arguments.output);
  if (!arguments.solve.quiet) {
    log_start("run", model.scene);
    log_line(describe(model));
  }
  if (arguments.solve.resume)
    require_same_scene(model.scene, directory);
  else
    write_model(model, directory);
  solve_folder(directory, arguments.solve);
  const std::string table = post_folder(directory);
  if (!arguments.solve.quiet) print_answer(table);
}

}  // namespace

void add_run_command(CLI::App& program) {
  auto* command = program.add_subcommand("run", "Mesh, solve and post-process a scene");
  const auto arguments = std::make_shared<RunArguments>();
  add_scene_arguments(*command, arguments->scene);
  add_output_argument(*command, arguments->output);
  add_solve_arguments(*command, arguments->solve);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace weaveform
