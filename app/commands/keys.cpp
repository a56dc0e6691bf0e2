// weaveform keys: the reference of all scene keys, or of a material card's (docs/scene.md and docs/card.md are its
// output).
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands/commands.hpp"
#include "app/console.hpp"
#include "core/json/json_text.hpp"
#include "core/json/keys_json.hpp"
#include "fabric/card/card.hpp"
#include "mesher/scene/reader.hpp"

namespace weaveform {

void add_keys_command(CLI::App& program) {
  auto* command =
      program.add_subcommand("keys", "Print every scene key with type, unit, default and meaning (Markdown)");
  auto* card = command->add_flag("--card")->description("The keys of a material card instead");
  const auto json = std::make_shared<bool>(false);
  add_json_argument(*command, *json);
  command->callback([card, json] {
    const bool of_card = card->count() > 0;
    if (*json) return print_answer(json_text(keys_json(of_card ? card_keys() : scene_keys())));
    print_answer(of_card ? card_reference_markdown() : scene_reference_markdown());
  });
}

}  // namespace weaveform
