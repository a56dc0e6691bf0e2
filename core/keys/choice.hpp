// Keys whose value is one of a few words: an enum, and beside it the one table of its names, from which reading,
// writing back, messages, reference pages and reports follow:
//     enum class Section { incompressible, constant };
//     constexpr auto choices_of(Section) {
//       return std::to_array<Choice<Section>>({{Section::incompressible, "incompressible"},
//                                              {Section::constant, "constant"}});
//     }
// The table's order is that of the messages and of the reference.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace weaveform {

template <class Enum>
struct Choice {
  Enum value;
  std::string_view name;
};

template <class Enum>
concept NamedChoice = std::is_enum_v<Enum> && requires(Enum value) {
  choices_of(value);
};

// Its word in a file.
template <NamedChoice Enum>
[[nodiscard]] std::string name_of(Enum value) {
  for (const auto& choice : choices_of(value))
    if (choice.value == value) return std::string(choice.name);
  return {};
}

// Nothing when no value has this name.
template <NamedChoice Enum>
[[nodiscard]] std::optional<Enum> choice_named(std::string_view name) {
  for (const auto& choice : choices_of(Enum{}))
    if (choice.name == name) return choice.value;
  return std::nullopt;
}

template <NamedChoice Enum>
[[nodiscard]] std::vector<std::string> choice_names() {
  std::vector<std::string> names;
  for (const auto& choice : choices_of(Enum{})) names.emplace_back(choice.name);
  return names;
}

template <NamedChoice Enum>
[[nodiscard]] std::vector<std::string> names_of(const std::vector<Enum>& values) {
  std::vector<std::string> names;
  for (const Enum value : values) names.push_back(name_of(value));
  return names;
}

}  // namespace weaveform
