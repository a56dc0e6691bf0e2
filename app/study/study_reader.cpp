// Reads and checks study files; the key table is in study_schema.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/study/border_reader.hpp"
#include "app/study/reference_reader.hpp"
#include "app/study/study_schema.hpp"
#include "app/study/study_tables.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/scene/schema.hpp"

namespace weaveform::study {

namespace {

const std::vector<std::string> tables = {"set", "grid", "paired", "case", "convergence", "work_precision", "border"};

// The values of KEY = [...]; nullptr when complained.
const toml::array* list_at(const Entry& entry, Complaints& complaints) {
  const toml::array* list = entry.node->as_array();
  if (list != nullptr && !list->empty()) return list;
  complaints.add(*entry.node, fmt::format("'{}' must be a list of values; write it in [ ]", entry.key));
  return nullptr;
}

void read_grid(const toml::table& grid, Study& study, Complaints& complaints) {
  for (const Entry& entry : entries_of(grid)) {
    const toml::array* list = list_at(entry, complaints);
    if (list == nullptr) continue;
    Axis axis;
    for (const auto& item : *list) axis.point.push_back({.settings = {make_setting(entry.key, item)}});
    study.axes.push_back(std::move(axis));
  }
}

void read_paired(const toml::table& pairs, Study& study, Complaints& complaints) {
  Axis axis;
  for (const Entry& entry : entries_of(pairs)) {
    const toml::array* list = list_at(entry, complaints);
    if (list == nullptr) continue;
    if (axis.point.empty()) axis.point.resize(list->size());
    if (list->size() != axis.point.size()) {
      complaints.add(*entry.node,
                     fmt::format("'{}' has {} values, but those it is paired with have {}; give one for each",
                                 entry.key, list->size(), axis.point.size()));
      continue;
    }
    for (std::size_t i = 0; i < list->size(); ++i)
      axis.point[i].settings.push_back(make_setting(entry.key, (*list)[i]));
  }
  if (axis.point.empty())
    complaints.add(pairs, "[[paired]] has no key; add lists of values of scene keys");
  else
    study.axes.push_back(std::move(axis));
}

void read_cases(const std::vector<const toml::table*>& cases, Study& study, Complaints& complaints) {
  Axis axis;
  for (const toml::table* each : cases) axis.point.push_back(variant_of(*each, complaints));
  if (!axis.point.empty()) study.axes.push_back(std::move(axis));
}

// A key belongs to one axis, or to [set].
void check_keys_once(const Study& study, Complaints& complaints) {
  std::set<std::string> taken;
  for (const Setting& setting : study.set) taken.insert(setting.key);
  for (const Axis& axis : study.axes) {
    std::set<std::string> own;
    for (const Variant& point : axis.point)
      for (const Setting& setting : point.settings) {
        if (taken.contains(setting.key))
          complaints.add(setting.where,
                         fmt::format("'{}' is set twice; keep it in one of [set], [grid], [[paired]] and "
                                     "[[case]]",
                                     setting.key));
        own.insert(setting.key);
      }
    taken.insert(own.begin(), own.end());
  }
}

void read_convergence(const toml::table& root, Study& study, Complaints& complaints) {
  const toml::table* table = table_at(root, "convergence", complaints);
  if (table == nullptr) return;
  study.convergence_at = table->source();
  ConvergenceSpec& spec = study.convergence.emplace();
  read_keys(*table, "[convergence]", convergence_keys(), spec, complaints);
  require_keys(*table, "[convergence]", convergence_keys(), complaints);
  const toml::node* key = table->get("key");
  if (key == nullptr || spec.key.empty()) return;
  const auto varied = varied_keys(study);
  if (std::find(varied.begin(), varied.end(), spec.key) == varied.end())
    return complaints.add(*key, fmt::format("'{}' is not varied{}", spec.key, did_you_mean(spec.key, varied)));
  std::set<double> values;
  for (const Axis& axis : study.axes)
    for (const Variant& point : axis.point)
      for (const Setting& setting : point.settings) {
        if (setting.key != spec.key) continue;
        if (!setting.number || !(*setting.number > 0.0))
          complaints.add(setting.where,
                         fmt::format("'{}' is refined by [convergence]; its values must be numbers > 0", spec.key));
        else
          values.insert(*setting.number);
      }
  if (values.size() < 3)
    complaints.add(*key,
                   fmt::format("'{}' has {} different values; an observed order needs three", spec.key, values.size()));
}

}  // namespace

std::vector<std::string> varied_keys(const Study& study) {
  std::vector<std::string> keys;
  for (const Axis& axis : study.axes)
    for (const Variant& point : axis.point)
      for (const Setting& setting : point.settings)
        if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) keys.push_back(setting.key);
  if (study.border) keys.push_back(study.border->key);
  return keys;
}

std::filesystem::path scene_path(const Study& study) {
  return study.file.parent_path() / study.head.scene;
}

Study read_study(const std::filesystem::path& file) {
  return read_study_text(read_text_file(file, most_written_by_hand), file);
}

Study read_study_text(const std::string& text, const std::filesystem::path& name) {
  Complaints complaints(name.string());
  const toml::table root = parse_toml(text, name.string());
  Study study;
  study.file = name;
  read_keys(root, "a study file", head_keys(), study.head, complaints, tables);
  require_keys(root, "the study file", head_keys(), complaints);
  if (const toml::node* measures = root.get("measures")) study.measures_at = measures->source();
  if (const toml::node* repeats = root.get("repeats")) study.repeats_at = repeats->source();
  if (const auto* set = table_at(root, "set", complaints))
    for (const auto& [key, node] : entries_of(*set)) study.set.push_back(make_setting(key, *node));
  read_cases(tables_at(root, "case", complaints), study, complaints);
  for (const auto* pairs : tables_at(root, "paired", complaints)) read_paired(*pairs, study, complaints);
  if (const auto* grid = table_at(root, "grid", complaints)) read_grid(*grid, study, complaints);
  check_keys_once(study, complaints);
  if (study.axes.empty() && !root.contains("border") && complaints.count() == 0)
    complaints.add(root, "the study varies nothing; add [grid], [[paired]], [[case]] or [border]");
  read_convergence(root, study, complaints);
  read_work_precision(root, study, complaints);
  read_border(root, study, complaints);
  complaints.throw_if_any();
  return study;
}

}  // namespace weaveform::study
