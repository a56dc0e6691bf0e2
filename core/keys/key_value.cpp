#include "core/keys/key_value.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include "core/keys/nearest_name.hpp"

namespace weaveform {
namespace {

std::string_view words_of(toml::node_type type) {
  switch (type) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "text";
    case toml::node_type::integer:
      return "a whole number";
    case toml::node_type::floating_point:
      return "a number with a fraction";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string number_limits(const Limits& limits) {
  std::string words;
  if (std::isfinite(limits.least)) words = fmt::format("{} {}", limits.open ? ">" : ">=", limits.least);
  if (std::isfinite(limits.greatest)) words += fmt::format("{}<= {}", words.empty() ? "" : " and ", limits.greatest);
  return words;
}

std::string words_of(const Limits& limits, const std::string& unit) {
  const std::string words = number_limits(limits);
  const bool bare = words.empty() || unit.empty() || unit == "1";
  return bare ? words : words + " " + unit;
}

// No quantity in any of our units is smaller but for zero, or larger; squares and cubes of these still are numbers.
constexpr double least_size = 1e-15, greatest_size = 1e18;

bool within(const Limits& limits, double number) {
  return (limits.open ? number > limits.least : number >= limits.least) && number <= limits.greatest;
}

// The finite number of a node, or nothing after a complaint.
std::optional<double> number_of(const toml::node& node, const KeyRule& rule, const std::string& wanted,
                                Complaints& complaints) {
  double number = 0.0;
  if (const auto* whole = node.as_integer()) {
    number = static_cast<double>(whole->get());
  } else if (const auto* real = node.as_floating_point()) {
    number = real->get();
  } else {
    complain_type(node, rule, wanted, complaints);
    return std::nullopt;
  }
  if (!std::isfinite(number)) {
    complaints.add(node, fmt::format("'{}' is {}; it must be a finite number", rule.name, number));
  } else if (!within(rule.limits, number)) {
    complaints.add(node, fmt::format("'{}' is {}; it must be {}", rule.name, number, words_of(rule.limits, rule.unit)));
  } else if (std::abs(number) > greatest_size || (number != 0.0 && std::abs(number) < least_size)) {
    complaints.add(node, fmt::format("'{}' is {}; its size must be 0, or from {} to {}", rule.name, number, least_size,
                                     greatest_size));
  } else if (!within(limits_of(rule), number)) {
    complaints.add(node, fmt::format("'{}' is {}; it must be {}", rule.name, number, range_words(rule)));
  } else {
    return number;
  }
  return std::nullopt;
}

std::optional<std::string> text_of(const toml::node& node, const KeyRule& rule, const std::string& wanted,
                                   Complaints& complaints) {
  const auto* flag = node.as_boolean();
  if (!rule.false_word.empty() && flag != nullptr) {
    if (!flag->get()) return rule.false_word;
    complaints.add(node, fmt::format("'{}' is true; it must be {} or false", rule.name, range_words(rule)));
    return std::nullopt;
  }
  const auto* text = node.as_string();
  if (text == nullptr) {
    complain_type(node, rule, wanted, complaints);
    return std::nullopt;
  }
  if (text->get().empty()) {
    complaints.add(node, fmt::format("'{}' is empty; give {} or leave the key out", rule.name, wanted));
    return std::nullopt;
  }
  const auto& allowed = rule.allowed;
  if (!allowed.empty() && std::find(allowed.begin(), allowed.end(), text->get()) == allowed.end()) {
    std::string hint = did_you_mean(text->get(), allowed);
    if (!hint.starts_with("; did")) hint = rule.advice.empty() ? "" : "; " + rule.advice;
    complaints.add(node, fmt::format("'{}' is '{}'; it must be {}{}", rule.name, text->get(), range_words(rule), hint));
    return std::nullopt;
  }
  if (rule.identifier && !is_identifier(text->get())) {
    complaints.add(node,
                   fmt::format("'{}' is '{}'; it must begin with a letter and hold only letters, digits, '_' and '-'",
                               rule.name, text->get()));
    return std::nullopt;
  }
  return text->get();
}

// A TOML basic string: quote, backslash and control characters escaped.
std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (code < 0x20 || code == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(code));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

Limits limits_of(const KeyRule& rule) {
  Limits limits = rule.limits;
  if (rule.unit != "mm") return limits;
  if (limits.least < -greatest_length) limits.least = -greatest_length;
  if (limits.greatest > greatest_length) limits.greatest = greatest_length;
  return limits;
}

std::string range_words(const KeyRule& rule) {
  if (!rule.allowed.empty()) {
    std::vector<std::string> names;
    for (const auto& name : rule.allowed) names.push_back("'" + name + "'");
    return fmt::format("{}{}", names.size() > 1 ? "one of " : "", fmt::join(names, ", "));
  }
  return words_of(limits_of(rule), rule.unit);
}

void complain_type(const toml::node& node, const KeyRule& rule, const std::string& wanted, Complaints& complaints) {
  const std::string unit = rule.unit.empty() || rule.unit == "1" ? "" : fmt::format(" ({})", rule.unit);
  complaints.add(node, fmt::format("'{}' is {}; it must be {}{}", rule.name, words_of(node.type()), wanted, unit));
}

bool read_numbers(const toml::node& node, const KeyRule& rule, double* value, std::size_t count,
                  Complaints& complaints) {
  const std::string wanted =
      fmt::format("{}{} numbers{}", rule.one_for_all ? "1 or " : "", count, rule.or_auto ? " or \"auto\"" : "");
  if (rule.one_for_all && node.is_number()) {
    const auto number = number_of(node, rule, wanted, complaints);
    if (number) std::fill_n(value, count, *number);
    return number.has_value();
  }
  const auto* list = node.as_array();
  if (list == nullptr) {
    complain_type(node, rule, wanted, complaints);
    return false;
  }
  if (list->size() != count) {
    complaints.add(node, fmt::format("'{}' has {} values; it must be {}", rule.name, list->size(), wanted));
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = number_of((*list)[i], rule, "a number", complaints);
    good = good && number.has_value();
    if (number) value[i] = *number;
  }
  return good;
}

bool is_identifier(std::string_view text) {
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto inner = [&](char c) { return letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; };
  return !text.empty() && letter(text.front()) && std::all_of(text.begin(), text.end(), inner);
}

void read_value(const toml::node& node, const KeyRule& rule, bool& value, Complaints& complaints) {
  if (const auto* flag = node.as_boolean()) {
    value = flag->get();
  } else {
    complain_type(node, rule, type_words(value), complaints);
  }
}

void read_value(const toml::node& node, const KeyRule& rule, int& value, Complaints& complaints) {
  constexpr double largest = std::numeric_limits<int>::max();
  if (!node.is_integer()) return complain_type(node, rule, type_words(value), complaints);
  KeyRule bounded = rule;  // whatever the rule says, the value has to fit an int
  bounded.limits.least = std::max(bounded.limits.least, -largest);
  bounded.limits.greatest = std::min(bounded.limits.greatest, largest);
  if (const auto number = number_of(node, bounded, type_words(value), complaints)) value = static_cast<int>(*number);
}

void read_value(const toml::node& node, const KeyRule& rule, double& value, Complaints& complaints) {
  if (const auto number = number_of(node, rule, type_words(value), complaints)) value = *number;
}

void read_value(const toml::node& node, const KeyRule& rule, std::string& value, Complaints& complaints) {
  if (auto text = text_of(node, rule, type_words(value), complaints)) value = std::move(*text);
}

void read_value(const toml::node& node, const KeyRule& rule, std::vector<double>& value, Complaints& complaints) {
  const auto* list = node.as_array();
  if (list == nullptr) return complain_type(node, rule, type_words(value), complaints);
  std::vector<double> read(list->size());
  if (read_numbers(node, rule, read.data(), read.size(), complaints)) value = std::move(read);
}

void read_value(const toml::node& node, const KeyRule& rule, std::vector<std::string>& value, Complaints& complaints) {
  const auto* list = node.as_array();
  if (list == nullptr) return complain_type(node, rule, type_words(value), complaints);
  std::vector<std::string> read;
  for (const auto& item : *list) {
    auto text = text_of(item, rule, "a list of texts", complaints);
    if (!text) return;
    if (std::find(read.begin(), read.end(), *text) != read.end()) {
      complaints.add(item, fmt::format("'{}' names '{}' twice; name it once", rule.name, *text));
      return;
    }
    read.push_back(std::move(*text));
  }
  value = std::move(read);
}

void read_value(const toml::node& node, const KeyRule& rule, std::vector<std::vector<double>>& value,
                Complaints& complaints) {
  const auto* list = node.as_array();
  if (list == nullptr) return complain_type(node, rule, type_words(value), complaints);
  std::vector<std::vector<double>> read;
  for (const auto& item : *list) {
    const auto* inner = item.as_array();
    if (inner == nullptr) return complain_type(item, rule, type_words(value), complaints);
    read.emplace_back(inner->size());
    if (!read_numbers(item, rule, read.back().data(), read.back().size(), complaints)) return;
  }
  value = std::move(read);
}

void read_value(const toml::node& node, const KeyRule& rule, std::optional<double>& value, Complaints& complaints) {
  const auto* word = node.as_string();
  if (word != nullptr && word->get() == "auto") {
    value.reset();
  } else if (const auto number = number_of(node, rule, type_words(value), complaints)) {
    value = *number;
  }
}

TomlText toml_text(bool value) {
  return value ? "true" : "false";
}
TomlText toml_text(int value) {
  return fmt::format("{}", value);
}
TomlText toml_text(const std::string& value) {
  return value.empty() ? TomlText{} : quoted(value);
}

TomlText toml_text(double value) {
  // A minus zero would come back as the whole number 0; everything else is the shortest text with the same bits.
  if (value == 0.0) return std::signbit(value) ? "-0.0" : "0";
  return fmt::format("{}", value);
}

TomlText toml_text(const std::vector<double>& value) {
  std::vector<std::string> parts;
  for (const double number : value) parts.push_back(*toml_text(number));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

TomlText toml_text(const std::vector<std::string>& value) {
  if (value.empty()) return std::nullopt;
  std::vector<std::string> parts;
  for (const auto& text : value) parts.push_back(quoted(text));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

TomlText toml_text(const std::vector<std::vector<double>>& value) {
  if (value.empty()) return std::nullopt;
  std::vector<std::string> parts;
  for (const auto& inner : value) parts.push_back(*toml_text(inner));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

TomlText toml_text(const std::optional<double>& value) {
  return value ? toml_text(*value) : quoted("auto");
}

std::string type_words(const bool&) {
  return "true or false";
}
std::string type_words(const int&) {
  return "a whole number";
}
std::string type_words(const double&) {
  return "a number";
}
std::string type_words(const std::string&) {
  return "text";
}
std::string type_words(const std::vector<double>&) {
  return "a list of numbers";
}
std::string type_words(const std::vector<std::string>&) {
  return "a list of texts";
}
std::string type_words(const std::vector<std::vector<double>>&) {
  return "a list of lists of numbers";
}
std::string type_words(const std::optional<double>&) {
  return "a number or \"auto\"";
}

}  // namespace weaveform
