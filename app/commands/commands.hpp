// The commands of `weaveform`, one file each. Each function adds its command to the program, with its options and what
// it does when called; failures leave it as exceptions and are caught once, in main.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "app/cad_progress.hpp"
#include "mesher/tools/geo_script.hpp"
#include "solver/solve.hpp"

namespace weaveform {

void add_run_command(CLI::App& program);
void add_mesh_command(CLI::App& program);
void add_solve_command(CLI::App& program);
void add_post_command(CLI::App& program);
void add_render_command(CLI::App& program);
void add_dic_commands(CLI::App& post);  // compare, virtual, border
void add_report_command(CLI::App& post);
void add_check_command(CLI::App& program);
void add_drape_command(CLI::App& program);
void add_fit_command(CLI::App& program);
void add_chart_command(CLI::App& program);
void add_export_command(CLI::App& program);
void add_import_command(CLI::App& program);
void add_keys_command(CLI::App& program);
void add_tool_command(CLI::App& program);
void add_unit_cell_command(CLI::App& program);
void add_help_command(CLI::App& program);
void add_study_command(CLI::App& program);

// Options that several commands share, worded once.
struct SceneArguments {
  std::string scene;                   // file
  std::vector<std::string> overrides;  // "key=value"
  bool yes = false;                    // to memory, disk and hours beyond the bounds (app/stages/room.hpp)
};

// Of every command that may read an outline or tool; docs/tools.md says what it lifts.
inline void add_trust_argument(CLI::App& command) {
  command.add_flag_callback(
      "--trust-geo", [] { trust_geo_scripts(true); },
      "Run Gmsh scripts (.geo) whole, also what is not geometry in them: they may then start programs and write files");
}

inline void add_yes_argument(CLI::App& command, bool& yes) {
  command.add_flag("--yes", yes, "Begin although more memory, disk or time is expected to be needed than there is");
}

inline void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE", arguments.scene, "Scene file (TOML; 'weaveform keys' lists what it may hold)")
      ->required();
  // One value for each --set, so that a following SCENE is not taken for another override.
  command
      .add_option("--set", arguments.overrides,
                  "Override a value of the scene, e.g. --set grip.top.travel=40; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_trust_argument(command);
  add_yes_argument(command, arguments.yes);
}

inline void add_output_argument(CLI::App& command, std::string& directory) {
  command.add_option("-o,--output", directory, "Result folder (default: results/NAME of the scene file)")
      ->type_name("DIR");
}

inline void add_folder_argument(CLI::App& command, std::string& directory) {
  command.add_option("DIR", directory, "Result folder")->required();
  add_trust_argument(command);
}

inline void add_quiet_argument(CLI::App& command, bool& quiet) {
  command.add_flag_callback(
      "-q,--quiet",
      [&quiet] {
        quiet = true;
        show_cad_progress(false);
      },
      "Print nothing but warnings and errors");
}

// Of every command that prints an answer; after add_quiet_argument, where there is one, for then nothing is printed.
inline void add_json_argument(CLI::App& command, bool& json) {
  CLI::Option* option =
      command.add_flag("--json", json, "Print the answer as one JSON document instead (docs/results.md)");
  if (command.get_option_no_throw("--quiet") != nullptr) option->excludes("--quiet");
}

inline void add_verbose_argument(CLI::App& command, bool& verbose) {
  command.add_flag("-v,--verbose", verbose, "Print the complete scene first, with every default")->excludes("--quiet");
}

inline void add_force_argument(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "Overwrite files that Weaveform did not write; never an input of the command");
}

inline void add_solve_arguments(CLI::App& command, SolveOptions& options) {
  command.add_option("--threads", options.threads, "Threads; 0 chooses from the size; the results are the same bits")
      ->check(CLI::Range(0, 1024));
  command.add_flag("--resume", options.resume,
                   "Go on from the checkpoint that a stopped or killed run left in the result folder");
  add_quiet_argument(command, options.quiet);
}

}  // namespace weaveform
