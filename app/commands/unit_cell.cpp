// weaveform unit-cell: every variant of the shear cell through one cell of fabric, beside the analytical response.
#include <fmt/core.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages/output_folder.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "core/version/version.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"
#include "post/unit_cell/report.hpp"
#include "post/unit_cell/study.hpp"
#include "solver/result/chart_file.hpp"

namespace weaveform {

namespace {

struct UnitCellArguments {
  std::string material = FabricSpec{}.material;
  double to = 70.0;       // deg
  int increments = 1400;  // a twentieth of a degree each
  std::string output;
  bool force = false, quiet = false, json = false;
};

std::vector<std::filesystem::path> card_files(const std::string& material) {
  if (is_builtin_card(material)) return {};
  return {card_path(material, {})};
}

void unit_cell(const UnitCellArguments& arguments) {
  const Card card = load_card(arguments.material);
  UnitCellOptions options;
  options.to = arguments.to * std::numbers::pi / 180.0;
  options.increments = arguments.increments;
  const UnitCellStudy study = study_unit_cell(card, options);
  const std::filesystem::path directory = arguments.output.empty()
                                              ? std::filesystem::path("results") / ("unit_cell_" + card.name)
                                              : std::filesystem::path(arguments.output);
  const OutputFolder folder({.directory = directory,
                             .names = {"unit_cell.csv", "unit_cell.md", "unit_cell.svg", "unit_cell_error.svg"},
                             .inputs = card_files(arguments.material),
                             .can_force = true,
                             .force = arguments.force});
  log_warning(folder.trouble());
  write_text_whole(directory / "unit_cell.csv", unit_cell_csv(study));
  write_text_whole(directory / "unit_cell.md", unit_cell_markdown(study, version_line()));
  write_charts({{directory / "unit_cell.svg", unit_cell_chart(study)},
                {directory / "unit_cell_error.svg", unit_cell_error_chart(study)}});
  if (arguments.quiet) return;
  print_answer(arguments.json ? json_text(unit_cell_json(study)) : unit_cell_table(study));
  log_line(fmt::format("table, report, charts: {}/unit_cell.csv, .md, .svg, unit_cell_error.svg", directory.string()));
}

}  // namespace

void add_unit_cell_command(CLI::App& program) {
  auto* command =
      program.add_subcommand("unit-cell", "Error of every shear-cell variant on one sheared cell of fabric");
  const auto arguments = std::make_shared<UnitCellArguments>();
  command->add_option("--material", arguments->material, "Built-in card or card file")->capture_default_str();
  command->add_option("--to", arguments->to, "Shear angle in either sense, deg")
      ->type_name("DEG")
      ->check(CLI::Range(1.0, 85.0))
      ->capture_default_str();
  command->add_option("--increments", arguments->increments, "Equal increments from 0 to that angle")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->output, "Result folder (default: results/unit_cell_CARD)")
      ->type_name("DIR");
  add_force_argument(*command, arguments->force);
  add_quiet_argument(*command, arguments->quiet);
  add_json_argument(*command, arguments->json);
  command->callback([arguments] { unit_cell(*arguments); });
}

}  // namespace weaveform
