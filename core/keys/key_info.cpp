#include "core/keys/key_info.hpp"

#include <fmt/format.h>

namespace weaveform {
namespace {

// A bar would end the cell.
std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

std::string default_cell(const KeyInfo& key) {
  if (key.required) return "required";
  return key.standard.empty() ? "none" : fmt::format("`{}`", cell(key.standard));
}

}  // namespace

std::string markdown_table(const std::vector<KeyInfo>& keys) {
  std::string text = "| key | type | unit | default | allowed | meaning |\n|---|---|---|---|---|---|\n";
  for (const auto& key : keys) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", key.name, cell(key.type), key.unit, default_cell(key),
                        cell(key.range), cell(key.doc));
  }
  return text;
}

}  // namespace weaveform
