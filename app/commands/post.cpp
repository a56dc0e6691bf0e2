// weaveform post DIR: contours, summary and the table of a solved folder; `post compare`, `post virtual` and `post
// border` are in compare.cpp.
#include "post/post.hpp"

#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/commands/stage_log.hpp"
#include "app/console.hpp"
#include "app/stages/claims.hpp"
#include "core/json/json_text.hpp"

namespace weaveform {

namespace {

struct PostArguments {
  std::string directory;
  bool quiet = false, json = false;
};

}  // namespace

void add_post_command(CLI::App& program) {
  auto* command = program.add_subcommand("post", "Contours, summary and the printed table of a solved folder");
  const auto arguments = std::make_shared<PostArguments>();
  add_trust_argument(*command);
  command->add_option("DIR", arguments->directory, "Result folder");
  add_quiet_argument(*command, arguments->quiet);
  add_json_argument(*command, arguments->json);
  add_dic_commands(*command);
  add_report_command(*command);
  command->callback([arguments, command] {
    if (!command->get_subcommands().empty()) return;
    if (arguments->directory.empty()) throw InputError("DIR is required; 'weaveform post --help' tells more");
    ResultFolder result(arguments->directory);
    const OutputFolder folder(post_claim(arguments->directory, result.scene()));
    log_warning(folder.trouble());
    const Evaluation evaluation = evaluate(result);
    const PostAnswers answers = post_process(result, evaluation);
    log_warnings(answers.warnings);
    if (arguments->quiet) return;
    print_answer(arguments->json ? json_text(summary_json(evaluation.summary)) : answers.table);
    log_end(arguments->directory, "contours.vtp for ParaView, the verdict in summary.json");
  });
}

}  // namespace weaveform
