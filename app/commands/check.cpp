// weaveform check SCENE: reads a scene as `run` would, down to its mesh, and prints it complete with every default;
// with --resolved also what the program chose where the scene leaves it to it, however long that takes.
#include <fmt/format.h>

#include <cmath>
#include <ctime>
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
#include "solver/analysis/loading.hpp"

namespace weaveform {

namespace {

struct CheckArguments {
  SceneArguments scene;
  bool resolved = false, json = false;
};

constexpr double seconds_for_trials = 3.0;  // of a processor: a check answers while its reader waits

// Chooses what the scene leaves to trials, as `run` would. Where that takes longer than `seconds` the model stays as it
// is, and a line says what is known; else "".
std::string chosen_or_why_not(Resolved& model, const SceneArguments& scene, double seconds) {
  const std::clock_t begin = std::clock();
  const auto too_long = [&] { return static_cast<double>(std::clock() - begin) > seconds * CLOCKS_PER_SEC; };
  try {
    set_duration(model, choose_duration(scene.scene, scene.overrides, too_long));
    return "";
  } catch (const TrialsStopped& stopped) {
    const std::string known = stopped.so_far() > 0.0
                                  ? fmt::format("by those that have ended about {:.2g} s", stopped.so_far())
                                  : "none has ended yet";
    return fmt::format(
        "{}: left to trials, which take longer than {:g} s: 'check --resolved' and 'mesh' make them; {}, "
        "what follows is for {:.3g} s",
        duration_key, seconds, known, choose_loading(model).duration);
  }
}

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
  command->add_flag(
      "--resolved", arguments->resolved,
      "Print too what the scene came to: mesh, symmetry, duration, damping, step, laws, tools, threads; trials for a "
      "duration are then made however long they take");
  add_json_argument(*command, arguments->json);
  command->callback([arguments] {
    const SceneArguments& scene = arguments->scene;
    Resolved model = checked_model(scene.scene, scene.overrides, scene.yes, Look::with_first_step);
    const double seconds = arguments->resolved ? HUGE_VAL : seconds_for_trials;
    const std::string not_chosen = chosen_or_why_not(model, scene, seconds);
    const ExpectedRun expected = require_room(model, default_result_folder(scene.scene), scene.yes);
    log_warnings(warnings_before(model));
    const std::string resolved = arguments->resolved ? resolved_text(model) : "";
    if (arguments->json) return print_answer(json_text(check_json(model, expected, not_chosen, resolved)));
    const std::string left_out = not_chosen.empty() ? describe_automatic_duration(model) : not_chosen;
    print_answer(commented(describe(model)) + commented(taken_lines(model.scene)) +
                 (left_out.empty() ? "" : commented(left_out)) + commented(describe(expected)) +
                 scene_to_toml(model.scene) + resolved);
  });
}

}  // namespace weaveform
