// weaveform keys: the reference of all scene keys (docs/scene.md is its output).
#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

void add_keys_command(CLI::App& program) {
  auto* command =
      program.add_subcommand("keys", "Print every scene key with type, unit, default and meaning (Markdown)");
  command->callback([] { print_answer(scene_reference_markdown()); });
}

}  // namespace weaveform
