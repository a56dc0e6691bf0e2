// How a table's text is written, as settings name it.
#pragma once

#include <optional>

#include "core/keys/choice.hpp"

namespace weaveform {

enum class Delimiter { automatic, comma, semicolon, tab, space };
constexpr auto choices_of(Delimiter) {
  return std::to_array<Choice<Delimiter>>({{Delimiter::automatic, "auto"},
                                           {Delimiter::comma, "comma"},
                                           {Delimiter::semicolon, "semicolon"},
                                           {Delimiter::tab, "tab"},
                                           {Delimiter::space, "space"}});
}

// None when it is to be found.
[[nodiscard]] constexpr std::optional<char> character_of(Delimiter delimiter) {
  switch (delimiter) {
    case Delimiter::comma:
      return ',';
    case Delimiter::semicolon:
      return ';';
    case Delimiter::tab:
      return '\t';
    case Delimiter::space:
      return ' ';
    case Delimiter::automatic:
      break;
  }
  return std::nullopt;
}

enum class DecimalSign { automatic, point, comma };
constexpr auto choices_of(DecimalSign) {
  return std::to_array<Choice<DecimalSign>>(
      {{DecimalSign::automatic, "auto"}, {DecimalSign::point, "point"}, {DecimalSign::comma, "comma"}});
}

}  // namespace weaveform
