// A share for people: 0.0123 -> "1.23 %".
#pragma once

#include <fmt/format.h>

#include <string>

namespace weaveform {

[[nodiscard]] inline std::string percent(double share) {
  return fmt::format("{:.3g} %", 100.0 * share);
}

}  // namespace weaveform
