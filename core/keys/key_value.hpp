// One value of a key: what it may be, how it is read from TOML, written back and described. One overload per type; a
// room with a type of its own adds the same four overloads beside that type.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/keys/toml_document.hpp"

namespace weaveform {

// The numbers a key allows: least <= value <= greatest, least itself excluded when `open`.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  bool open = false;
};
[[nodiscard]] constexpr Limits above(double least, double greatest = std::numeric_limits<double>::infinity()) {
  return {least, greatest, true};
}
[[nodiscard]] constexpr Limits between(double least, double greatest) {
  return {least, greatest, false};
}
[[nodiscard]] constexpr Limits at_least(double least) {
  return {.least = least};
}

// No length in a scene is greater (a kilometre, in mm): sums and squares of what lies within keep their digits.
inline constexpr double greatest_length = 1e6;
// A place or a way, of either sign.
inline constexpr Limits any_length = between(-greatest_length, greatest_length);

// What the key table says about a key besides its type and default.
struct KeyRule {
  std::string name = {};
  std::string unit = {};                  // "" for text and switches, "1" for pure numbers
  Limits limits = {};                     // of each number of the value
  std::vector<std::string> allowed = {};  // of a text or of each text of a list; empty: any
  std::string advice = {};                // of a text: said of a word that is none of `allowed` and near to none
  std::string false_word = {};            // of a text: the word that a plain false stands for
  bool required = false;
  bool one_for_all = false;  // a single number stands for every number of an array
  bool or_auto = false;      // somebody else reads "auto"; messages say that it may stand there
  bool identifier = false;  // a letter, then letters, digits, '_' or '-' (names become column headings and --set paths)
  std::string doc = {};
};

// Reads `node` into `value`; on a wrong type or range `value` is left alone and a complaint added. Numbers must be
// finite; a whole number is accepted where a number is wanted, not the reverse.
void read_value(const toml::node& node, const KeyRule& rule, bool& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, int& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, double& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, std::string& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, std::vector<double>& value, Complaints& complaints);
void read_value(const toml::node& node, const KeyRule& rule, std::vector<std::string>& value, Complaints& complaints);
// A list of lists of numbers, the inner ones of any length.
void read_value(const toml::node& node, const KeyRule& rule, std::vector<std::vector<double>>& value,
                Complaints& complaints);
// A number, or the word "auto" for none.
void read_value(const toml::node& node, const KeyRule& rule, std::optional<double>& value, Complaints& complaints);

// The value as TOML that reads back to the same bits; nullopt when the key is absent (an empty text is an absent one).
using TomlText = std::optional<std::string>;
[[nodiscard]] TomlText toml_text(bool value);
[[nodiscard]] TomlText toml_text(int value);
[[nodiscard]] TomlText toml_text(double value);  // shortest text with the same bits
[[nodiscard]] TomlText toml_text(const std::string& value);
[[nodiscard]] TomlText toml_text(const std::vector<double>& value);
[[nodiscard]] TomlText toml_text(const std::vector<std::string>& value);
[[nodiscard]] TomlText toml_text(const std::vector<std::vector<double>>& value);  // an empty one is absent
[[nodiscard]] TomlText toml_text(const std::optional<double>& value);

// The type in the words of a message: "a number", "2 numbers", ...
[[nodiscard]] std::string type_words(const bool&);
[[nodiscard]] std::string type_words(const int&);
[[nodiscard]] std::string type_words(const double&);
[[nodiscard]] std::string type_words(const std::string&);
[[nodiscard]] std::string type_words(const std::vector<double>&);
[[nodiscard]] std::string type_words(const std::vector<std::string>&);
[[nodiscard]] std::string type_words(const std::vector<std::vector<double>>&);
[[nodiscard]] std::string type_words(const std::optional<double>&);

// The rule's own limits, and for lengths (mm) those that all lengths have.
[[nodiscard]] Limits limits_of(const KeyRule& rule);
// "> 0 mm", ">= 0.05 and <= 100", "one of 'a', 'b'", or "" when anything goes.
[[nodiscard]] std::string range_words(const KeyRule& rule);
// A letter, then letters, digits, '_' or '-'.
[[nodiscard]] bool is_identifier(std::string_view text);
// Complaint "'size' is text; it must be 2 numbers (mm)".
void complain_type(const toml::node& node, const KeyRule& rule, const std::string& wanted, Complaints& complaints);
// Reads `count` numbers, or one for all where the rule allows it; false when complained.
bool read_numbers(const toml::node& node, const KeyRule& rule, double* value, std::size_t count,
                  Complaints& complaints);

template <std::size_t N>
void read_value(const toml::node& node, const KeyRule& rule, std::array<double, N>& value, Complaints& complaints) {
  auto read = value;
  if (read_numbers(node, rule, read.data(), N, complaints)) value = read;
}
template <std::size_t N>
void read_value(const toml::node& node, const KeyRule& rule, std::optional<std::array<double, N>>& value,
                Complaints& complaints) {
  std::array<double, N> read{};
  if (read_numbers(node, rule, read.data(), N, complaints)) value = read;
}
template <std::size_t N>
[[nodiscard]] TomlText toml_text(const std::array<double, N>& value) {
  return toml_text(std::vector<double>(value.begin(), value.end()));
}
template <std::size_t N>
[[nodiscard]] TomlText toml_text(const std::optional<std::array<double, N>>& value) {
  return value ? toml_text(*value) : std::nullopt;
}
template <std::size_t N>
[[nodiscard]] std::string type_words(const std::array<double, N>&) {
  return std::to_string(N) + " numbers";
}
template <std::size_t N>
[[nodiscard]] std::string type_words(const std::optional<std::array<double, N>>&) {
  return std::to_string(N) + " numbers";
}

}  // namespace weaveform
