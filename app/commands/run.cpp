// weaveform run SCENE: mesh, solve and post in one go; with --accuracy, on the coarsest mesh that is fine enough.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/stages/checked_model.hpp"
#include "app/stages/chosen_duration.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/record.hpp"
#include "app/stages/stages.hpp"
#include "app/study/accuracy.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "mesher/automatic/take.hpp"
#include "mesher/scene/taken.hpp"
#include "post/report/result_report.hpp"
#include "post/trust/expected_waves.hpp"

namespace weaveform {

namespace {

struct RunArguments {
  SceneArguments scene;
  std::string output;
  SolveOptions solve;
  std::string accuracy;  // "2%"; "": the scene's own mesh
  std::vector<std::string> measures;
  double finest = 1.0;
  bool report = false, verbose = false, json = false;
};

constexpr const char* what_to_open =
    "result.pvd and contours.vtp for ParaView, history.csv for a spreadsheet, the verdict in summary.json";

std::filesystem::path folder_of(const RunArguments& arguments) {
  return arguments.output.empty() ? default_result_folder(arguments.scene.scene)
                                  : std::filesystem::path(arguments.output);
}

std::string report_line(const std::filesystem::path& directory) {
  return fmt::format("{}: open it in a browser", (directory / file_name::report).string());
}

std::string json_with_accuracy(const Summary& summary, const study::Accuracy& found) {
  nlohmann::ordered_json json = summary_json(summary);
  json["accuracy"] = found.json;
  return json_text(json);
}

void run_to_accuracy(const RunArguments& arguments) {
  if (arguments.solve.resume) throw InputError("--accuracy goes on where it stopped by itself; leave --resume out");
  study::AccuracyOptions options;
  options.tolerance = study::parse_accuracy(arguments.accuracy);
  options.finest = arguments.finest;
  options.measures = arguments.measures;
  options.threads = arguments.solve.threads;
  if (!arguments.solve.quiet) options.log = log_line;
  const std::filesystem::path directory = folder_of(arguments);
  const auto overrides =
      with_duration(arguments.scene.overrides, choose_duration(arguments.scene.scene, arguments.scene.overrides));
  const Scene scene = read_taken_scene(arguments.scene.scene, overrides);
  if (!arguments.solve.quiet) log_lines(taken_lines(scene));
  const OutputFolder folder(result_claim(directory, scene));
  log_warning(folder.trouble());
  const InterruptWatch signals;
  options.stop_requested = InterruptWatch::requested;
  const study::Accuracy found = study::find_accuracy(arguments.scene.scene, overrides, directory, options);
  clear_folder(directory, scene);
  constexpr auto over = std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing;
  std::filesystem::copy(found.results, directory, over);
  write_text_whole(directory / study::report_name::accuracy, found.table);
  ResultFolder result(directory);
  const Evaluation evaluation = evaluate(result);
  const PostAnswers answers = post_process(result, evaluation);
  log_warnings(answers.warnings);
  if (arguments.report) write_report_page(result, evaluation, directory / file_name::report);
  if (!arguments.solve.quiet) {
    print_answer(arguments.json ? json_with_accuracy(evaluation.summary, found) : answers.table + "\n" + found.table);
    if (arguments.report) log_line(report_line(directory));
  }
  if (!found.met)
    throw PhysicsError(fmt::format(
        "{}: a mesh error within {:.3g} % cannot be shown; the finest mesh (coarsening x {:g}) is in {}, what "
        "is known of its error in accuracy.md there; a finer --finest may show it",
        arguments.scene.scene, 100.0 * options.tolerance, found.factor, directory.string()));
  if (!arguments.solve.quiet)
    log_line(
        fmt::format("mesh error within {:.3g} %: coarsening x {:g}, in {}; errors of law, card, friction and speed "
                    "are not in it",
                    100.0 * options.tolerance, found.factor, directory.string()));
}

void run(const RunArguments& arguments) {
  if (!arguments.accuracy.empty()) return run_to_accuracy(arguments);
  const std::filesystem::path directory = folder_of(arguments);
  const SceneArguments& asked = arguments.scene;
  const Record record = arguments.solve.resume ? record_of(directory) : Record{};
  const auto overrides = with_record(record, asked.scene, asked.overrides);
  Resolved model = checked_model(asked.scene, overrides, asked.yes, Look::for_all_complaints);
  set_duration(model, choose_duration(asked.scene, overrides));
  keep_record(record, model);
  std::string expected;
  if (!arguments.solve.resume) expected = describe(require_room(model, directory, arguments.scene.yes));
  if (!arguments.solve.quiet) {
    log_start("run", model.scene, arguments.verbose);
    log_line(describe(model));
    log_lines(taken_lines(model.scene));
    if (!expected.empty()) log_line(expected);
  }
  const OutputFolder folder(result_claim(directory, model.scene));
  log_warning(folder.trouble());
  const std::vector<std::string> said = warnings_before(model);
  log_warnings(said);
  const Listener listener = console_listener(arguments.solve.quiet);
  ResultFolder result = arguments.solve.resume ? go_on_with_model(std::move(model), directory, listener)
                                               : write_model(std::move(model), directory, listener);
  solve_on_console(result, arguments.solve, true);  // there is room, as asked above
  const Evaluation evaluation = evaluate(result);
  const PostAnswers answers = post_process(result, evaluation);
  log_warnings(not_said(answers.warnings, said));
  if (arguments.report) write_report_page(result, evaluation, directory / file_name::report);
  if (arguments.solve.quiet) return;
  print_answer(arguments.json ? json_text(summary_json(evaluation.summary)) : answers.table);
  log_end(directory, what_to_open);
  if (arguments.report) log_line(report_line(directory));
}

}  // namespace

void add_run_command(CLI::App& program) {
  auto* command = program.add_subcommand("run", "Mesh, solve and post-process a scene");
  const auto arguments = std::make_shared<RunArguments>();
  add_scene_arguments(*command, arguments->scene);
  add_output_argument(*command, arguments->output);
  add_solve_arguments(*command, arguments->solve);
  add_verbose_argument(*command, arguments->verbose);
  add_json_argument(*command, arguments->json);
  command->add_flag("--report", arguments->report, "Write DIR/report.html too, a page that opens in any browser");
  auto* accuracy =
      command
          ->add_option("--accuracy", arguments->accuracy,
                       "Solve coarser meshes first and take the coarsest whose mesh error, the part that refinement "
                       "removes, is within this, e.g. 2% (docs/study.md)")
          ->type_name("ERROR");
  command
      ->add_option("--measure", arguments->measures,
                   "With --accuracy: what must be that exact (default: greatest shear angle, last forces); repeatable")
      ->type_name("NAME")
      ->allow_extra_args(false)
      ->needs(accuracy);
  command
      ->add_option("--finest", arguments->finest,
                   "With --accuracy: least factor on the scene's coarsening (default 1: no finer than the scene)")
      ->check(CLI::Range(0.01, 8.0))
      ->needs(accuracy);
  command->callback([arguments] { run(*arguments); });
}

}  // namespace weaveform
