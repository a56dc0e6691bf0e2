// weaveform keys: the reference of all scene keys, or of a material card's (docs/scene.md and docs/card.md are its
// output).
#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

void add_keys_command(CLI::App& program) {
  auto* command =
      program.add_subcommand("keys", "Print every scene key with type, unit, default and meaning (Markdown)");
  auto* card = command->add_flag("--card")->description("The keys of a material card instead");
  command->callback(
      [card] { print_answer(card->count() > 0 ? card_reference_markdown() : scene_reference_markdown()); });
}

}  // namespace weaveform
