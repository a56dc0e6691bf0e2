#include "app/study/border_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/study/study_schema.hpp"
#include "app/study/study_tables.hpp"

namespace weaveform::study {

void read_value(const toml::node& node, const KeyRule& rule, OptionalNumber& value, Complaints& complaints) {
  double number = 0.0;
  if (!node.is_number()) return complain_type(node, rule, type_words(value), complaints);
  const std::size_t before = complaints.count();
  read_value(node, rule, number, complaints);
  if (complaints.count() == before) value.value = number;
}
TomlText toml_text(const OptionalNumber& value) {
  return value.value ? toml_text(*value.value) : std::nullopt;
}
std::string type_words(const OptionalNumber&) {
  return "a number";
}

void read_value(const toml::node& node, const KeyRule& rule, NumberOrName& value, Complaints& complaints) {
  if (node.is_string()) return read_value(node, rule, value.name, complaints);
  OptionalNumber number;
  if (!node.is_number()) return complain_type(node, rule, type_words(value), complaints);
  read_value(node, rule, number, complaints);
  value.number = number.value;
}
TomlText toml_text(const NumberOrName& value) {
  return value.number ? toml_text(*value.number) : toml_text(value.name);
}
std::string type_words(const NumberOrName&) {
  return "a number or text";
}

namespace {

void check_condition(const toml::table& table, const BorderCondition& condition, Complaints& complaints) {
  const bool compares = condition.at_most.value || condition.at_least.value || condition.within.value;
  const bool has_of = condition.of.number || !condition.of.name.empty();
  if (condition.measure.empty() && compares)
    complaints.add(table, "[[border.while]] compares, but no 'measure'; add the one it is about");
  if (!condition.measure.empty() && !compares)
    complaints.add(table, fmt::format("[[border.while]] says nothing of '{}'; add at_most, at_least, or within and of",
                                      condition.measure));
  if (condition.measure.empty() && !compares && !condition.no_warnings)
    complaints.add(table, "[[border.while]] asks for nothing; add a measure, or no_warnings = true");
  if (condition.within.value.has_value() != has_of)
    complaints.add(table, "'within' and 'of' go together: |measure - of|/|of| is at most 'within'; add the other");
  if (condition.of.number == 0.0)
    complaints.add(*table.get("of"), "'of' is 0, of which nothing is a fraction; use at_most and at_least");
}

void check_bracket(const toml::table& table, const BorderSpec& spec, Complaints& complaints) {
  if (!table.contains("holds") || !table.contains("fails")) return;
  if (spec.holds == spec.fails)
    complaints.add(*table.get("fails"), "'fails' is where 'holds' is; there is nothing between them to bisect");
  if (spec.scale == BisectionScale::logarithmic && !(spec.holds > 0.0 && spec.fails > 0.0))
    complaints.add(table, "scale = \"logarithmic\" needs 'holds' and 'fails' > 0; use \"linear\"");
}

void check_key(const toml::table& table, const BorderSpec& spec, const Study& study, Complaints& complaints) {
  const toml::node* key = table.get("key");
  if (key == nullptr || spec.key.empty()) return;
  if (spec.key.find('.') == std::string::npos)
    complaints.add(*key, fmt::format("'{}' is no scene key; write it as --set does, TABLE.KEY", spec.key));
  const auto has = [&](const Settings& settings) {
    return std::any_of(settings.begin(), settings.end(), [&](const auto& setting) { return setting.key == spec.key; });
  };
  bool set = has(study.set);
  for (const Axis& axis : study.axes)
    for (const Variant& point : axis.point) set = set || has(point.settings);
  if (set)
    complaints.add(*key, fmt::format("'{}' is bisected here and set elsewhere; leave it out of [set] and of what is "
                                     "varied",
                                     spec.key));
}

}  // namespace

void read_border(const toml::table& root, Study& study, Complaints& complaints) {
  const toml::table* table = table_at(root, "border", complaints);
  if (table == nullptr) return;
  BorderSpec spec;
  spec.where = table->source();
  read_keys(*table, "[border]", border_keys(), spec, complaints, {"while"});
  require_keys(*table, "[border]", border_keys(), complaints);
  check_bracket(*table, spec, complaints);
  check_key(*table, spec, study, complaints);
  for (const toml::table* each : tables_at(*table, "while", complaints, "border.")) {
    BorderCondition& condition = spec.condition.emplace_back();
    condition.where = each->source();
    const std::size_t before = complaints.count();
    read_keys(*each, "[[border.while]]", condition_keys(), condition, complaints);
    if (complaints.count() == before) check_condition(*each, condition, complaints);
  }
  for (const char* other : {"convergence", "work_precision"})
    if (root.contains(other))
      complaints.add(
          *root.get(other),
          fmt::format("[{}] does not go with [border], whose cases follow from results; make two studies", other));
  if (study.head.repeats > 1)
    complaints.add(study.repeats_at, "'repeats' does not go with [border], which measures no time; leave it out");
  study.border = std::move(spec);
}

}  // namespace weaveform::study
