#include "core/keys/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace weaveform {

void Complaints::add(const toml::source_region& where, const std::string& what) {
  if (where.path && where.path->starts_with(override_mark)) {
    found_.emplace_back(0, 0, fmt::format("{}: {}", *where.path, what));
    return;
  }
  found_.emplace_back(where.begin.line, where.begin.column,
                      fmt::format("{}:{}:{}: {}", file_, where.begin.line, where.begin.column, what));
}

void Complaints::add_override(const std::string& key, const std::string& what) {
  found_.emplace_back(0, 0, fmt::format("{}{}: {}", override_mark, key, what));
}

void Complaints::throw_if_any() const {
  if (found_.empty()) return;
  auto sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Complaint& a, const Complaint& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
  });
  std::vector<std::string> lines;
  for (const auto& complaint : sorted) {
    const auto& text = std::get<2>(complaint);
    if (std::find(lines.begin(), lines.end(), text) == lines.end()) lines.push_back(text);
  }
  throw InputError(lines);
}

toml::table parse_toml(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw InputError(fmt::format("{}:{}:{}: not valid TOML: {}", name, begin.line, begin.column, error.description()));
  }
}

}  // namespace weaveform
