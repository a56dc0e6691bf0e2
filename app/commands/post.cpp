// weaveform post DIR: contours, summary and the table of a solved folder.
#include <memory>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages.hpp"

namespace weaveform {

namespace {

struct PostArguments {
  std::string directory;
  bool quiet = false;
};

}  // namespace

void add_post_command(CLI::App& program) {
  auto* command = program.add_subcommand("post", "Contours, summary and the printed table of a solved folder");
  const auto arguments = std::make_shared<PostArguments>();
  add_folder_argument(*command, arguments->directory);
  add_quiet_argument(*command, arguments->quiet);
  command->callback([arguments] {
    const std::string table = post_folder(arguments->directory);
    if (!arguments->quiet) print_answer(table);
  });
}

}  // namespace weaveform
