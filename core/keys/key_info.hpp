// What the documentation says about the keys of a file.
#pragma once

#include <string>
#include <vector>

namespace weaveform {

// A key as a reader of the reference sees it.
struct KeyInfo {
  std::string table;     // "blank"
  std::string name;      // "size"
  std::string type;      // "2 numbers"
  std::string unit;      // "mm"
  std::string standard;  // the default as TOML; "" when required or absent
  std::string range;     // "> 0 mm"; "" when anything goes
  bool required = false;
  std::string doc;
};

// A markdown table of keys with type, unit, default, range and meaning.
[[nodiscard]] std::string markdown_table(const std::vector<KeyInfo>& keys);

}  // namespace weaveform
