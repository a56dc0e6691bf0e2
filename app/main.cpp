// The one executable: hands the arguments to a command and turns what it throws into an exit code (app/console.hpp).
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <exception>
#include <sstream>

#include "app/cad_progress.hpp"
#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/process.hpp"
#include "app/usage.hpp"
#include "core/error.hpp"
#include "core/version/version.hpp"
#include "solver/result/chart_file.hpp"

namespace {

constexpr const char* description =
    "Weaveform predicts how a woven reinforcement forms: yarns at their interval, merged with cells that carry shear.\n"
    "Exit codes: 0 done, 2 input wrong, 3 the physics failed, 4 files, 130 interrupted (checkpoint left), 1 a defect.";

int run_command(int argc, char** argv) {
  CLI::App program(description, "weaveform");
  program.set_version_flag("-V,--version", weaveform::version_line());
  program.require_subcommand(1);
  weaveform::add_run_command(program);
  weaveform::add_mesh_command(program);
  weaveform::add_drape_command(program);
  weaveform::add_solve_command(program);
  weaveform::add_post_command(program);
  weaveform::add_render_command(program);
  weaveform::add_check_command(program);
  weaveform::add_fit_command(program);
  weaveform::add_chart_command(program);
  weaveform::add_unit_cell_command(program);
  weaveform::add_tool_command(program);
  weaveform::add_study_command(program);
  weaveform::add_export_command(program);
  weaveform::add_import_command(program);
  weaveform::add_keys_command(program);
  weaveform::add_help_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    // --help and --version come this way too, with code 0.
    if (error.get_exit_code() == 0) {
      std::ostringstream answer;
      const int code = program.exit(error, answer);
      weaveform::print_answer(answer.str());
      return code;
    }
    throw weaveform::InputError(weaveform::usage_complaint(program, error, argc, argv));
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int argc, char** argv) {
  weaveform::prepare_process();
  weaveform::show_cad_progress(true);
  weaveform::hear_of_missing_charts(weaveform::log_warning);
  try {
    return run_command(argc, argv);
  } catch (const std::exception& error) {
    return weaveform::report(error);
  }
}
