#include "app/study/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/keys/key_value.hpp"

namespace weaveform::study {

namespace {

constexpr std::string_view series_key = "series";

void flatten(const toml::table& table, const std::string& prefix, std::vector<Entry>& entries) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const auto* inner = node.as_table())
      flatten(*inner, key + ".", entries);
    else
      entries.push_back({key, &node});
  }
}

// TOML on one line.
std::string text_of(const toml::node& node) {
  if (const auto* list = node.as_array()) {
    std::string text;
    for (const auto& item : *list) text += (text.empty() ? "" : ", ") + text_of(item);
    return "[" + text + "]";
  }
  if (const auto* word = node.as_string()) return toml_text(word->get()).value_or("\"\"");
  if (const auto* number = node.as_floating_point()) return *toml_text(number->get());
  std::ostringstream text;
  node.visit([&](const auto& value) {
    if constexpr (toml::is_value<decltype(value)>) text << value;
  });
  return text.str();
}

std::optional<double> number_of(const toml::node& node) {
  if (const auto* list = node.as_array()) {
    std::optional<double> same;
    for (const auto& item : *list) {
      const auto number = number_of(item);
      if (!number || (same && *same != *number)) return std::nullopt;
      same = number;
    }
    return same;
  }
  return node.is_number() ? node.value<double>() : std::nullopt;
}

}  // namespace

std::vector<Entry> entries_of(const toml::table& table) {
  std::vector<Entry> entries;
  flatten(table, "", entries);
  const auto before = [](const Entry& a, const Entry& b) {
    const auto &one = a.node->source().begin, &other = b.node->source().begin;
    return one.line != other.line ? one.line < other.line : one.column < other.column;
  };
  std::stable_sort(entries.begin(), entries.end(), before);
  return entries;
}

Setting make_setting(const std::string& key, const toml::node& node) {
  return {key, text_of(node), number_of(node), node.source()};
}

Variant variant_of(const toml::table& table, Complaints& complaints) {
  Variant variant;
  const KeyRule rule{.name = std::string(series_key)};
  for (const auto& [key, node] : entries_of(table)) {
    if (key == series_key)
      read_value(*node, rule, variant.series, complaints);
    else
      variant.settings.push_back(make_setting(key, *node));
  }
  return variant;
}

const toml::table* table_at(const toml::table& root, const std::string& name, Complaints& complaints) {
  const toml::node* node = root.get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) complaints.add(*node, fmt::format("'{0}' must be a table; begin it with [{0}]", name));
  return node->as_table();
}

std::vector<const toml::table*> tables_at(const toml::table& root, const std::string& name, Complaints& complaints,
                                          const std::string& parent) {
  std::vector<const toml::table*> found;
  const toml::node* node = root.get(name);
  if (node == nullptr) return found;
  if (!node->is_array_of_tables()) {
    complaints.add(*node, fmt::format("'{0}' is a list of tables; begin each with [[{1}{0}]]", name, parent));
    return found;
  }
  for (const auto& item : *node->as_array()) found.push_back(item.as_table());
  return found;
}

}  // namespace weaveform::study
