// weaveform solve DIR: the explicit analysis of a folder that `weaveform mesh` made.
#include <fmt/core.h>

#include <memory>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/claims.hpp"
#include "app/stages/stages.hpp"
#include "core/version/version.hpp"

namespace weaveform {

namespace {

struct SolveArguments {
  std::string directory;
  SolveOptions solve;
  bool yes = false;
};

}  // namespace

void add_solve_command(CLI::App& program) {
  auto* command = program.add_subcommand("solve", "Run the analysis of DIR/mesh.vtu and DIR/scene.toml");
  const auto arguments = std::make_shared<SolveArguments>();
  add_folder_argument(*command, arguments->directory);
  add_solve_arguments(*command, arguments->solve);
  add_yes_argument(*command, arguments->yes);
  command->callback([arguments] {
    if (!arguments->solve.quiet) log_line(fmt::format("{}: solve {}", version_line(), arguments->directory));
    ResultFolder result(arguments->directory);
    const OutputFolder folder(later_claim(arguments->directory, result.scene()));
    log_warning(folder.trouble());
    solve_on_console(result, arguments->solve, arguments->yes || arguments->solve.resume);
    if (!arguments->solve.quiet)
      log_end(arguments->directory,
              fmt::format("result.pvd for ParaView, history.csv; next: weaveform post {}", arguments->directory));
  });
}

}  // namespace weaveform
