// weaveform check SCENE: reads a scene as `run` would, down to its mesh, and prints it complete with every default;
// with --resolved also what the program chose where the scene leaves it to it.
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/checked_model.hpp"
#include "app/stages/chosen_duration.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/mesh_json.hpp"
#include "app/stages/resolved_text.hpp"
#include "app/stages/stages.hpp"
#include "core/json/json_text.hpp"
#include "mesher/scene/reader.hpp"
#include "mesher/scene/taken.hpp"
#include "post/trust/expected_waves.hpp"

namespace weaveform {

namespace {

struct CheckArguments {
  SceneArguments scene;
  bool resolved = false, json = false;
};

// Every line of it a comment of the scene that follows.
std::string commented(const std::string& text) {
  std::string lines = "# ";
  for (const char c : text) lines += c == '\n' ? std::string("\n# ") : std::string(1, c);
  return lines + "\n";
}
std::string commented(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += commented(line);
  return text;
}

}  // namespace

void add_check_command(CLI::App& program) {
  auto* command = program.add_subcommand("check", "Check a scene and print it with every default; writes nothing");
  const auto arguments = std::make_shared<CheckArguments>();
  add_scene_arguments(*command, arguments->scene);
  command->add_flag("--resolved", arguments->resolved,
                    "Print too what the scene came to: mesh, symmetry, duration, damping, step, laws, tools, threads");
  add_json_argument(*command, arguments->json);
  command->callback([arguments] {
    const SceneArguments& scene = arguments->scene;
    Resolved model = checked_model(scene.scene, scene.overrides, scene.yes, Look::with_first_step);
    set_duration(model, choose_duration(scene.scene, scene.overrides));
    const ExpectedRun expected = require_room(model, default_result_folder(scene.scene), scene.yes);
    log_warnings(warnings_before(model));
    const std::string resolved = arguments->resolved ? resolved_text(model) : "";
    if (arguments->json) return print_answer(json_text(check_json(model, expected, resolved)));
    print_answer(commented(describe(model)) + commented(taken_lines(model.scene)) + commented(describe(expected)) +
                 scene_to_toml(model.scene) + resolved);
  });
}

}  // namespace weaveform
