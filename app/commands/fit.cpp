// weaveform fit FIT: material card from raw tests, with a report, tables and charts.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages/output_folder.hpp"
#include "app/stages/specimen_trials.hpp"
#include "core/chart/chart.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "core/json/keys_json.hpp"
#include "fabric/identify/identify.hpp"
#include "solver/result/chart_file.hpp"

namespace weaveform {

namespace {

constexpr const char* kept_card = "card_replaced.toml";

struct FitArguments {
  std::string file;
  std::string output;
  bool keys = false;
  bool force = false, quiet = false, json = false;
};

// The fit file, its base card and every test file.
std::vector<std::filesystem::path> input_files(const identify::FitSpec& spec) {
  const std::filesystem::path file = spec.file;
  std::vector<std::filesystem::path> files = {file};
  if (!spec.head.base.empty() && !is_builtin_card(spec.head.base)) files.push_back(card_path(spec.head.base, file));
  for (const auto* tests :
       {&spec.tensile, &spec.shear_frame, &spec.bias_extension, &spec.moment_curvature, &spec.cantilever})
    for (const auto& test : *tests)
      for (const auto& name : test.files) files.push_back(file.parent_path() / name);
  return files;
}

// The card of an earlier fit into this folder, with what a person may have typed into it since.
std::string replaced_card(const std::filesystem::path& directory) {
  const auto file = directory / "card.toml";
  return std::filesystem::is_regular_file(file) ? read_text_file(file, most_written_by_hand) : "";
}

// What was done to the rows of each specimen.
void say_notes(const identify::Identification& found) {
  const auto say = [](const auto& specimens) {
    for (const auto& specimen : specimens)
      for (const auto& note : specimen.notes) log_line(fmt::format("note: {}: {}", specimen.name, note));
  };
  for (const auto& yarn : found.yarns) say(yarn.specimens);
  if (found.frame) say(found.frame->specimens);
  if (found.bias) say(found.bias->specimens);
}

void fit(const FitArguments& arguments) {
  if (arguments.keys)
    return print_answer(arguments.json ? json_text(keys_json(identify::fit_keys()))
                                       : identify::fit_reference_markdown());
  if (arguments.file.empty()) throw InputError("FIT is required; 'weaveform fit --help' tells more");
  const std::filesystem::path file = arguments.file;
  const std::filesystem::path directory = arguments.output.empty() ? std::filesystem::path("results") / file.stem()
                                                                   : std::filesystem::path(arguments.output);
  const auto spec = identify::read_fit(file);
  const std::string replaced = replaced_card(directory);
  SpecimenTrials trials(spec);
  const identify::Simulation simulation{
      .run = [&](const auto& test, const auto& fabric, auto mesh) { return trials.run(test, fabric, mesh); },
      .tell =
          [&](const std::string& line) {
            if (!arguments.quiet) log_line(line);
          }};
  const auto found = identify::identify(spec, replaced, (directory / "card.toml").string(), simulation);
  for (const auto& warning : found.warnings) log_warning(warning);
  if (!arguments.quiet) say_notes(found);
  const auto outputs = identify::output_files(found);
  OutputClaim claim{
      .directory = directory, .names = {}, .inputs = input_files(spec), .can_force = true, .force = arguments.force};
  for (const auto& output : outputs) claim.names.push_back(output.name);
  if (found.replaces_other) claim.names.emplace_back(kept_card);
  const OutputFolder folder(claim);
  log_warning(folder.trouble());
  if (found.replaces_other) {
    write_text_whole(directory / kept_card, replaced);
    log_line(fmt::format("the card that is replaced is kept as {}", (directory / kept_card).string()));
  }
  std::vector<std::pair<std::filesystem::path, Chart>> charts;
  for (const auto& output : outputs) {
    if (output.chart)
      charts.emplace_back(directory / output.name, *output.chart);
    else
      write_text_whole(directory / output.name, output.text);
  }
  write_charts(charts);
  if (arguments.quiet) return;
  print_answer(arguments.json ? json_text(identify::fit_json(found)) : identify::summary_markdown(found));
  log_line(fmt::format("card: {}, report: {}", (directory / "card.toml").string(), (directory / "report.md").string()));
}

}  // namespace

void add_fit_command(CLI::App& program) {
  auto* command = program.add_subcommand("fit", "Material card from raw tests of yarns and fabric");
  const auto arguments = std::make_shared<FitArguments>();
  command->add_option("FIT", arguments->file, "Fit file (TOML; 'weaveform fit --keys' lists what it may hold)");
  command->add_option("-o,--output", arguments->output, "Result folder (default: results/NAME of the fit file)")
      ->type_name("DIR");
  command->add_flag("--keys", arguments->keys, "Print every key of a fit file (Markdown)");
  add_force_argument(*command, arguments->force);
  add_quiet_argument(*command, arguments->quiet);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { fit(*arguments); });
}

}  // namespace weaveform
