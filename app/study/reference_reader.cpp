#include "app/study/reference_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/study/study_schema.hpp"
#include "app/study/study_tables.hpp"
#include "core/keys/nearest_name.hpp"

namespace weaveform::study {

namespace {

const std::vector<std::string> below = {"case", "limit_of", "value", "uncertainty"};

// [work_precision.NAME], nullptr when absent or complained.
const toml::table* below_at(const toml::table& table, const std::string& name, Complaints& complaints) {
  const toml::node* given = table.get(name);
  if (given != nullptr && !given->is_table())
    complaints.add(*given, fmt::format("'{0}' must be a table; begin it with [work_precision.{0}]", name));
  return given != nullptr ? given->as_table() : nullptr;
}

Variant pick_at(const toml::table& table, const Study& study, Complaints& complaints) {
  Variant pick = variant_of(table, complaints);
  const auto varied = varied_keys(study);
  for (const Setting& setting : pick.settings)
    if (std::find(varied.begin(), varied.end(), setting.key) == varied.end())
      complaints.add(setting.where,
                     fmt::format("'{}' is not varied{}", setting.key, did_you_mean(setting.key, varied)));
  return pick;
}

std::vector<ReferenceValue> values_at(const toml::table& table, bool names, Complaints& complaints) {
  std::vector<ReferenceValue> values;
  for (const auto& [measure, node] : entries_of(table)) {
    ReferenceValue value{measure, std::nullopt, "", node->source()};
    const auto* name = node->as_string();
    if (names && name != nullptr)
      value.other = name->get();
    else if (node->is_number() && std::isfinite(*node->value<double>()))
      value.number = node->value<double>();
    else
      complaints.add(*node, fmt::format("'{}' must be a number{}", measure,
                                        names ? ", or the name of another measure of the same case" : ""));
    values.push_back(value);
  }
  return values;
}

// Which tables each kind of reference takes, and what it needs.
void check_tables(const toml::table& table, const WorkPrecisionSpec& spec, const Study& study, Complaints& complaints) {
  const auto only_with = [&](const char* name, std::initializer_list<ErrorReference> kinds, const char* hint) {
    const bool fits =
        std::any_of(kinds.begin(), kinds.end(), [&](ErrorReference kind) { return spec.reference == kind; });
    if (table.contains(name) && !fits)
      complaints.add(*table.get(name), fmt::format("[work_precision.{}] has no meaning with reference = \"{}\"; {}",
                                                   name, name_of(spec.reference), hint));
  };
  only_with("case", {ErrorReference::one_case}, "set reference = \"case\"");
  only_with("limit_of", {ErrorReference::limit}, "set reference = \"limit\"");
  only_with("value", {ErrorReference::value}, "set reference = \"value\"");
  only_with("uncertainty", {ErrorReference::one_case, ErrorReference::value}, "a limit has its own; leave it out");
  const Variant& pick = study.reference.reference_case;
  if (spec.reference == ErrorReference::one_case && pick.settings.empty() && pick.series.empty())
    complaints.add(table, "reference = \"case\" needs [work_precision.case] with values of varied keys; add it");
  if (spec.reference == ErrorReference::value && study.reference.value.empty())
    complaints.add(table,
                   "reference = \"value\" needs [work_precision.value] with what each measure should be; add it");
  if (spec.reference == ErrorReference::limit && !study.convergence)
    complaints.add(table, "reference = \"limit\" needs [convergence]; add it, or set reference = \"case\"");
}

}  // namespace

void read_work_precision(const toml::table& root, Study& study, Complaints& complaints) {
  const toml::table* table = table_at(root, "work_precision", complaints);
  if (table == nullptr) return;
  study.work_precision_at = table->source();
  WorkPrecisionSpec& spec = study.work_precision.emplace();
  read_keys(*table, "[work_precision]", work_precision_keys(), spec, complaints, below);
  if (const auto* given = below_at(*table, "case", complaints))
    study.reference.reference_case = pick_at(*given, study, complaints);
  if (const auto* given = below_at(*table, "limit_of", complaints))
    study.reference.limit_of = pick_at(*given, study, complaints);
  if (const auto* given = below_at(*table, "value", complaints))
    study.reference.value = values_at(*given, true, complaints);
  if (const auto* given = below_at(*table, "uncertainty", complaints))
    study.reference.uncertainty = values_at(*given, false, complaints);
  check_tables(*table, spec, study, complaints);
}

}  // namespace weaveform::study
