// The cards that are built into the program: the files of material/cards, embedded when the build is configured.
#pragma once

#include <string>
#include <vector>

namespace weaveform {

struct BuiltinCard {
  std::string name;
  std::string text;  // TOML
};

[[nodiscard]] const std::vector<BuiltinCard>& builtin_cards();

}  // namespace weaveform
