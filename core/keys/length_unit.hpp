// Units of length as files and people name them.
#pragma once

#include <optional>

#include "core/keys/choice.hpp"

namespace weaveform {

enum class LengthUnit { mm, cm, m, inch };
constexpr auto choices_of(LengthUnit) {
  return std::to_array<Choice<LengthUnit>>(
      {{LengthUnit::mm, "mm"}, {LengthUnit::cm, "cm"}, {LengthUnit::m, "m"}, {LengthUnit::inch, "inch"}});
}

// mm in one of it; none is taken for mm.
[[nodiscard]] constexpr double millimetres_in(std::optional<LengthUnit> unit) {
  switch (unit.value_or(LengthUnit::mm)) {
    case LengthUnit::cm:
      return 10.0;
    case LengthUnit::m:
      return 1000.0;
    case LengthUnit::inch:
      return 25.4;
    case LengthUnit::mm:
      break;
  }
  return 1.0;
}

}  // namespace weaveform
