// weaveform study STUDY: a scene in many variants, in parallel; one table, convergence, charts (docs/study.md).
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/interrupt.hpp"
#include "app/stages/output_folder.hpp"
#include "app/study/border_run.hpp"
#include "app/study/report.hpp"
#include "app/study/runner.hpp"
#include "app/study/snakemake.hpp"
#include "core/error.hpp"
#include "core/json/json_text.hpp"
#include "core/json/keys_json.hpp"

namespace weaveform {

namespace {

struct StudyArguments {
  std::string file;
  std::string output;
  std::string format;  // of --export
  int jobs = 0;
  bool collect = false, retry = false, report = false, keys = false, force = false, quiet = false;
  bool json = false;
};

int jobs_of(const StudyArguments& arguments, const study::Study& plan) {
  if (arguments.jobs > 0) return arguments.jobs;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / plan.head.threads);
}

void run_all(const StudyArguments& arguments, const study::Study& plan, const std::vector<study::Case>& cases,
             const std::filesystem::path& directory) {
  const study::Measures measures = study::measures_of(plan);
  study::RunOptions options;
  options.jobs = jobs_of(arguments, plan);
  options.threads = plan.head.threads;
  options.repeats = plan.head.repeats;
  options.retry = arguments.retry;
  if (!arguments.quiet) options.log = log_line;
  const InterruptWatch signals;
  options.stop_requested = InterruptWatch::requested;
  options.first_done = [&](const study::Case& done) { study::check_measures(plan, measures, done, directory); };
  if (!arguments.quiet)
    log_line(fmt::format("study: {} cases{}, {} at a time", cases.size(),
                         plan.border ? " at the ends of what is bisected" : "", options.jobs));
  const int run =
      plan.border ? study::run_borders(plan, directory, options) : study::run_cases(cases, directory, options);
  if (!arguments.quiet && run == 0) log_line("every case has been run before");
}

// Marks the folder as ours, or refuses it; who runs cases in it holds DIR/cases.
void claim_folder(const study::Study& plan, const std::filesystem::path& directory, bool force) {
  const OutputFolder folder({.directory = directory,
                             .names = joined({study::report_files(), {"Snakefile", "cases/*"}}),
                             .inputs = {plan.file, study::scene_path(plan)},
                             .can_force = true,
                             .force = force});
  log_warning(folder.trouble());
}

void study_command(const StudyArguments& arguments) {
  if (arguments.keys)
    return print_answer(arguments.json ? json_text(keys_json(study::study_keys())) : study::study_reference_markdown());
  if (arguments.file.empty()) throw InputError("STUDY is required; 'weaveform study --help' tells more");
  const study::Study plan = study::read_study(arguments.file);
  const std::vector<study::Case> cases = plan.border ? study::border_ends(plan) : study::expand(plan);
  const std::filesystem::path directory = arguments.output.empty() ? std::filesystem::path("results") / plan.file.stem()
                                                                   : std::filesystem::path(arguments.output);
  if (arguments.format.empty() || !plan.border)
    claim_folder(plan, directory, arguments.force);  // a border is no workflow
  if (!arguments.format.empty()) {
    study::export_snakemake(plan, cases, directory);
    const std::string workflow = (directory / "Snakefile").string();
    if (arguments.json) print_answer(json_text({{"cases", cases.size()}, {"snakefile", workflow}}));
    if (!arguments.quiet)
      log_line(fmt::format("{} cases; run them: snakemake --directory {} --snakefile {} --cores N", cases.size(),
                           directory.string(), workflow));
    return;
  }
  if (!arguments.collect) run_all(arguments, plan, cases, directory);
  const study::Report report = plan.border ? study::write_border_report(plan, directory, arguments.report)
                                           : study::write_report(plan, cases, directory, arguments.report);
  if (!arguments.quiet) {
    print_answer(arguments.json ? json_text(report.json) : report.answer);
    for (const std::string& line : report.complaints) log_line("warning: " + line);
    log_line(fmt::format("{} done, {} failed, {} not run; table: {}, report: {}", report.done, report.failed,
                         report.missing, (directory / study::report_name::table).string(),
                         (directory / study::report_name::page).string()));
  }
  if (plan.border && report.borders == 0)
    throw PhysicsError(fmt::format("{}: no border is found; why is in border.csv", directory.string()));
  if (report.done == 0)
    throw PhysicsError(fmt::format("{}: no case is done; how each ended is in the table", directory.string()));
}

}  // namespace

void add_study_command(CLI::App& program) {
  auto* command = program.add_subcommand("study", "Run a scene in many variants, in parallel, into one table");
  const auto arguments = std::make_shared<StudyArguments>();
  add_trust_argument(*command);
  command->add_option("STUDY", arguments->file, "Study file (TOML; 'weaveform study --keys' lists what it may hold)");
  command->add_option("-o,--output", arguments->output, "Folder (default: results/NAME of the study file)")
      ->type_name("DIR");
  command->add_option("-j,--jobs", arguments->jobs, "Cases at a time (default: cores / threads of a case)")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--retry", arguments->retry, "Run failed cases once more");
  auto* collect =
      command->add_flag("--collect", arguments->collect, "Run nothing; make the table of what has been run");
  command->add_option("--export", arguments->format, "Run nothing; write the study as a workflow")
      ->check(CLI::IsMember({"snakemake"}))
      ->excludes(collect);
  command->add_flag("--report", arguments->report, "Write a report of each case too, as 'weaveform post report' does");
  command->add_flag("--keys", arguments->keys, "Print every key of a study file (Markdown)");
  add_force_argument(*command, arguments->force);
  add_quiet_argument(*command, arguments->quiet);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { study_command(*arguments); });
}

}  // namespace weaveform
