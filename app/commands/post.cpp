// weaveform post DIR: contours, summary and the table of a solved folder; `post compare`, `post virtual` and `post
// border` are in compare.cpp.
#include <memory>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "app/stages/result_folder.hpp"
#include "app/stages/stages.hpp"

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
  add_trust_argument(*command);
  command->add_option("DIR", arguments->directory, "Result folder");
  add_quiet_argument(*command, arguments->quiet);
  add_dic_commands(*command);
  command->callback([arguments, command] {
    if (!command->get_subcommands().empty()) return;
    if (arguments->directory.empty()) throw InputError("DIR is required; 'weaveform post --help' tells more");
    const OutputFolder folder(post_claim(arguments->directory, scene_of(arguments->directory)));
    log_warning(folder.trouble());
    const std::string table = post_folder(arguments->directory);
    if (arguments->quiet) return;
    print_answer(table);
    log_end(arguments->directory, "contours.vtp for ParaView, the verdict in summary.json");
  });
}

}  // namespace weaveform
