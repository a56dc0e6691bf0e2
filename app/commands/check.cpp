// weaveform check SCENE: reads a scene as `run` would, down to its mesh, and prints it complete with every default.
#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/checked_model.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/stages.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

void add_check_command(CLI::App& program) {
  auto* command = program.add_subcommand("check", "Check a scene and print it with every default; writes nothing");
  const auto arguments = std::make_shared<SceneArguments>();
  add_scene_arguments(*command, *arguments);
  command->callback([arguments] {
    const Resolved model = checked_model(arguments->scene, arguments->overrides, arguments->yes, Look::with_first_step);
    const std::string expected = require_room(model, default_result_folder(arguments->scene), arguments->yes);
    log_warnings(early_warnings(model));
    print_answer("# " + describe(model) + "\n# " + expected + "\n" + scene_to_toml(model.scene));
  });
}

}  // namespace weaveform
