// Units of length as files and people name them.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace weaveform {

inline const std::vector<std::string> length_units = {"mm", "cm", "m", "inch"};

// mm in one of `length_units`; "" is taken for "mm".
[[nodiscard]] inline double millimetres_in(const std::string& unit) {
  static const std::map<std::string, double> size = {
      {"", 1.0}, {"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"inch", 25.4}};
  return size.at(unit);
}

}  // namespace weaveform
