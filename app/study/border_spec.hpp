// [border] of a study file, as plain data: where a method stops to hold, sought by bisection of one scene key.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/study/choices.hpp"
#include "core/keys/key_value.hpp"
#include "core/keys/toml_document.hpp"

namespace weaveform::study {

// The overloads below add to those of key_value.hpp, and do not hide them.
using weaveform::read_value;
using weaveform::toml_text;
using weaveform::type_words;

// A number that may be left out.
struct OptionalNumber {
  std::optional<double> value;
};
void read_value(const toml::node& node, const KeyRule& rule, OptionalNumber& value, Complaints& complaints);
[[nodiscard]] TomlText toml_text(const OptionalNumber& value);
[[nodiscard]] std::string type_words(const OptionalNumber&);

// A number, or the name of a measure, or nothing.
struct NumberOrName {
  std::optional<double> number;
  std::string name;
};
void read_value(const toml::node& node, const KeyRule& rule, NumberOrName& value, Complaints& complaints);
[[nodiscard]] TomlText toml_text(const NumberOrName& value);
[[nodiscard]] std::string type_words(const NumberOrName&);

// `of` of a condition that means the case at the group's `holds` end.
inline constexpr const char* at_holds_end = "holds";

// [[border.while]]: what a done case must meet to hold.
struct BorderCondition {
  std::string measure;
  OptionalNumber at_most, at_least;  // of the measure's value
  OptionalNumber within;             // |value − of|/|of|
  NumberOrName of;
  bool no_warnings = false;  // the run says nothing against itself
  toml::source_region where = {};
};

struct BorderSpec {
  std::string key;          // scene key that is bisected
  double holds = 0.0;       // where the method holds,
  double fails = 0.0;       // and where it does not
  double tolerance = 0.02;  // |fails − holds| over the greater of both; logarithmic: |ln(fails/holds)|
  BisectionScale scale = BisectionScale::linear;  // which middle halves the bracket
  std::vector<BorderCondition> condition;
  toml::source_region where = {};
};

}  // namespace weaveform::study
