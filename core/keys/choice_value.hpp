// Choices as values of keys: the overloads of key_value.hpp for an enum with names, one that may be left out, and a
// list.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/keys/choice.hpp"
#include "core/keys/key_value.hpp"

namespace weaveform {

// The words that a key of this type may hold; none for types that are no choice.
template <class Value>
[[nodiscard]] std::vector<std::string> allowed_words(const Value&) {
  return {};
}
template <NamedChoice Enum>
[[nodiscard]] std::vector<std::string> allowed_words(const Enum&) {
  return choice_names<Enum>();
}
template <NamedChoice Enum>
[[nodiscard]] std::vector<std::string> allowed_words(const std::optional<Enum>&) {
  return choice_names<Enum>();
}
template <NamedChoice Enum>
[[nodiscard]] std::vector<std::string> allowed_words(const std::vector<Enum>&) {
  return choice_names<Enum>();
}

// `rule.allowed` holds the words above.
template <NamedChoice Enum>
void read_value(const toml::node& node, const KeyRule& rule, Enum& value, Complaints& complaints) {
  std::string word;
  read_value(node, rule, word, complaints);
  if (const auto chosen = choice_named<Enum>(word)) value = *chosen;
}
template <NamedChoice Enum>
void read_value(const toml::node& node, const KeyRule& rule, std::optional<Enum>& value, Complaints& complaints) {
  std::string word;
  read_value(node, rule, word, complaints);
  if (const auto chosen = choice_named<Enum>(word)) value = chosen;
}
template <NamedChoice Enum>
void read_value(const toml::node& node, const KeyRule& rule, std::vector<Enum>& value, Complaints& complaints) {
  const std::size_t before = complaints.count();
  std::vector<std::string> words;
  read_value(node, rule, words, complaints);
  if (complaints.count() != before) return;
  value.clear();
  for (const auto& word : words) value.push_back(*choice_named<Enum>(word));
}

template <NamedChoice Enum>
[[nodiscard]] TomlText toml_text(const Enum& value) {
  return toml_text(name_of(value));
}
template <NamedChoice Enum>
[[nodiscard]] TomlText toml_text(const std::optional<Enum>& value) {
  return value ? toml_text(name_of(*value)) : std::nullopt;
}
template <NamedChoice Enum>
[[nodiscard]] TomlText toml_text(const std::vector<Enum>& value) {
  return toml_text(names_of(value));
}

template <NamedChoice Enum>
[[nodiscard]] std::string type_words(const Enum&) {
  return type_words(std::string());
}
template <NamedChoice Enum>
[[nodiscard]] std::string type_words(const std::optional<Enum>&) {
  return type_words(std::string());
}
template <NamedChoice Enum>
[[nodiscard]] std::string type_words(const std::vector<Enum>&) {
  return type_words(std::vector<std::string>());
}

}  // namespace weaveform
