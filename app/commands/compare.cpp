// weaveform post compare RESULT MEASUREMENT..., post virtual RESULT and post border RESULT: measured point fields
// beside the simulation, the simulation as a measurement, and how wide an instrument makes the borders of its zones.
#include "post/dic/comparison/compare.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages/output_folder.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "core/json/keys_json.hpp"
#include "core/keys/nearest_name.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "post/dic/readers/measurement.hpp"
#include "post/dic/settings/settings_form.hpp"
#include "post/dic/virtual/export.hpp"
#include "post/dic/virtual/zone_border.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

struct DicArguments {
  std::string result;
  std::vector<std::string> measurement;
  std::string settings;
  std::vector<std::string> overrides;
  std::string output;
  std::string format = "aramis";
  std::vector<double> facets = {2.0, 4.0, 6.0, 8.0, 10.0};
  std::string form;  // settings file to be written
  bool keys = false, force = false, quiet = false, json = false;
};

void require_result(const DicArguments& arguments) {
  if (arguments.result.empty()) throw InputError("RESULT is required; '--help' tells more");
}

// What both read: the result folder's files, the settings and what they name.
std::vector<fs::path> files_read(const DicArguments& arguments, const dic::Settings& settings) {
  std::vector<fs::path> files = {arguments.settings};
  if (!settings.load.file.empty()) files.push_back(fs::path(settings.file).parent_path() / settings.load.file);
  for (const char* name : {file_name::scene, file_name::mesh, file_name::index, file_name::history})
    files.push_back(fs::path(arguments.result) / name);
  return files;
}

OutputClaim claim_of(const DicArguments& arguments, const fs::path& output, std::vector<fs::path> inputs,
                     FileNames names) {
  return {.directory = output,
          .names = std::move(names),
          .inputs = std::move(inputs),
          .can_force = true,
          .force = arguments.force};
}

// The settings as they are, with what the measurement leaves open, as a file to fill in.
void write_form(const DicArguments& arguments) {
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(arguments.form, ignored)))
    throw InputError(
        fmt::format("{}: is there already and is not overwritten; name another file for --write-settings, "
                    "or remove it",
                    arguments.form));
  const auto settings = dic::read_settings(arguments.settings, arguments.overrides);
  const auto questions =
      arguments.measurement.empty() ? dic::Questions{} : dic::questions_of(arguments.measurement, settings);
  write_text_whole(arguments.form, dic::settings_form(settings, questions));
  if (arguments.json) {
    nlohmann::ordered_json json = {{"settings", arguments.form}, {"questions", nlohmann::ordered_json::array()}};
    for (const auto& question : questions) json["questions"].push_back(dic::question_line(question));
    print_answer(json_text(json));
  }
  if (arguments.quiet) return;
  for (const auto& question : questions) log_line(dic::question_line(question));
  log_line(fmt::format("written: {}; {} question(s) to answer in it, then run with --settings {}", arguments.form,
                       questions.size(), arguments.form));
}

void run_compare(const DicArguments& arguments) {
  if (arguments.keys)
    return print_answer(arguments.json ? json_text(keys_json(dic::settings_keys()))
                                       : dic::settings_reference_markdown());
  if (!arguments.form.empty()) return write_form(arguments);
  require_result(arguments);
  if (arguments.measurement.empty())
    throw InputError("MEASUREMENT is required: the files of the point fields, or their folder");
  const auto settings = dic::read_settings(arguments.settings, arguments.overrides);
  const fs::path output = arguments.output.empty() ? fs::path(arguments.result) / dic::file_name::default_comparison
                                                   : fs::path(arguments.output);
  std::vector<fs::path> inputs = files_read(arguments, settings);
  for (const auto& file : dic::measurement_files(arguments.measurement)) inputs.push_back(file);
  const OutputFolder folder(claim_of(arguments, output, inputs, dic::comparison_files()));
  log_warning(folder.trouble());
  const auto comparison = dic::compare(arguments.result, arguments.measurement, settings, output);
  if (arguments.quiet) return;
  print_answer(arguments.json ? json_text(dic::comparison_json(comparison)) : dic::verdict_table(comparison));
  log_line(fmt::format("written: {}", (output / dic::file_name::comparison).string()));
}

dic::MeasurementFormat written_format(const std::string& word) {
  const auto format = choice_named<dic::MeasurementFormat>(word);
  if (format == dic::MeasurementFormat::aramis || format == dic::MeasurementFormat::dice) return *format;
  throw InputError(
      fmt::format("--format is '{}'; it must be 'aramis' or 'dice'{}", word, did_you_mean(word, {"aramis", "dice"})));
}

void run_virtual(const DicArguments& arguments) {
  require_result(arguments);
  const auto format = written_format(arguments.format);
  const auto settings = dic::read_settings(arguments.settings, arguments.overrides);
  const fs::path output = arguments.output.empty() ? fs::path(arguments.result) / dic::file_name::default_virtual
                                                   : fs::path(arguments.output);
  const OutputFolder folder(claim_of(arguments, output, files_read(arguments, settings), dic::virtual_files()));
  log_warning(folder.trouble());
  const auto made = dic::export_virtual(arguments.result, format, settings, output);
  if (arguments.quiet) return;
  log_line(fmt::format("{} stages of {} points: {}; what they need to be read: {}", made.files.size(), made.points,
                       (output / dic::file_name::stages).string(), made.settings.string()));
}

void run_border(const DicArguments& arguments) {
  require_result(arguments);
  const auto settings = dic::read_settings(arguments.settings, arguments.overrides);
  const auto borders = dic::zone_border_widths(arguments.result, arguments.facets, settings);
  print_answer(arguments.json ? json_text(dic::zone_border_json(borders)) : dic::zone_border_table(borders));
}

CLI::App* add_command(CLI::App& post, const char* name, const char* doc, DicArguments& arguments) {
  auto* command = post.add_subcommand(name, doc);
  command->add_option("RESULT", arguments.result, "Result folder of a solved scene");
  command
      ->add_option("--settings", arguments.settings, "Settings file (TOML; 'weaveform post compare --keys' lists it)")
      ->type_name("FILE");
  command
      ->add_option("--set", arguments.overrides, "Override a setting, e.g. --set instrument.facet_size=4; repeatable")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
  return command;
}

}  // namespace

void add_dic_commands(CLI::App& post) {
  const auto arguments = std::make_shared<DicArguments>();
  auto* compare = add_command(post, "compare", "Measured point fields (DIC) beside the simulation", *arguments);
  compare->add_option("MEASUREMENT", arguments->measurement, "Files of the measurement in order, or their folder");
  compare->add_option("-o,--output", arguments->output, "Folder of the comparison (default: RESULT/comparison)")
      ->type_name("DIR");
  compare
      ->add_option("--write-settings", arguments->form,
                   "Write a settings file to fill in, with the questions that the measurement leaves open, and end")
      ->type_name("FILE");
  compare->add_flag("--keys", arguments->keys, "Print every key of the settings file (Markdown)");
  add_force_argument(*compare, arguments->force);
  add_quiet_argument(*compare, arguments->quiet);
  add_json_argument(*compare, arguments->json);
  compare->callback([arguments] { run_compare(*arguments); });

  auto* make =
      add_command(post, "virtual", "Export the simulation as an instrument would have measured it", *arguments);
  make->add_option("--format", arguments->format, "'aramis' or 'dice' (default aramis)");
  make->add_option("-o,--output", arguments->output, "Folder of the virtual measurement (default: RESULT/virtual)")
      ->type_name("DIR");
  add_force_argument(*make, arguments->force);
  add_quiet_argument(*make, arguments->quiet);
  make->callback([arguments] { run_virtual(*arguments); });

  auto* border = add_command(post, "border", "Width of a bias extension's zone borders against facet size", *arguments);
  border->add_option("--facet", arguments->facets, "Facet size, mm; repeatable (default 2, 4, 6, 8, 10)")
      ->allow_extra_args(false);
  add_json_argument(*border, arguments->json);
  border->callback([arguments] { run_border(*arguments); });
}

}  // namespace weaveform
