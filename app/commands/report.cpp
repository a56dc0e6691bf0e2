// weaveform post report DIR: the report of a result, one HTML file that opens without a network.
#include "app/study/report.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/output_folder.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "post/report/result_report.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string directory, output;
  bool force = false, quiet = false;
};

void refuse_study(const fs::path& directory) {
  if (fs::exists(directory / file_name::mesh) || !fs::exists(directory / study::report_name::table)) return;
  throw InputError(
      fmt::format("{}: is the folder of a study, whose report is {} there; 'weaveform study FILE --output {} --report' "
                  "writes it anew "
                  "and one for each of its cases",
                  directory.string(), study::report_name::page, directory.string()));
}

void write_page(const ReportArguments& arguments) {
  refuse_study(arguments.directory);
  ResultFolder result(arguments.directory);
  if (arguments.output.empty()) {
    const OutputFolder folder(report_claim(arguments.directory, result.scene()));
    log_warning(folder.trouble());
    write_report_page(result, evaluate(result), fs::path(arguments.directory) / file_name::report);
  } else {
    std::vector<fs::path> inputs = input_files(result.scene());
    for (const FrameFile& frame : result.frames()) inputs.push_back(frame.file);
    for (const char* name :
         {file_name::scene, file_name::mesh, file_name::index, file_name::history, file_name::statistics})
      inputs.push_back(fs::path(arguments.directory) / name);
    require_writable(arguments.output, inputs, arguments.force);
    write_report_page(result, evaluate(result), arguments.output);
  }
  if (arguments.quiet) return;
  const fs::path written =
      arguments.output.empty() ? fs::path(arguments.directory) / file_name::report : fs::path(arguments.output);
  log_line(fmt::format("written: {} ({:.1f} MB); open it in a browser", written.string(),
                       1e-6 * static_cast<double>(fs::file_size(written))));
}

}  // namespace

void add_report_command(CLI::App& post) {
  auto* command =
      post.add_subcommand("report", "One HTML page of a result: verdict, part in 3-D, charts; opens offline");
  const auto arguments = std::make_shared<ReportArguments>();
  add_folder_argument(*command, arguments->directory);
  command->add_option("-o,--output", arguments->output, "The page (default: DIR/report.html)")->type_name("FILE");
  add_force_argument(*command, arguments->force);
  add_quiet_argument(*command, arguments->quiet);
  command->callback([arguments] { write_page(*arguments); });
}

}  // namespace weaveform
