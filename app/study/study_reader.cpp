// Reads and checks study files; the key table is in study_schema.cpp.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "app/study/study_schema.hpp"
#include "mesher/base/error.hpp"
#include "mesher/scene/schema.hpp"

namespace weaveform::study {

namespace {

const std::vector<std::string> tables = {"set", "grid", "paired", "case", "convergence", "work_precision"};

struct Entry {
  std::string key;
  const toml::node* node;
};

// The entries of a table whose keys may be dotted (nested tables), in the order of the file.
void flatten(const toml::table& table, const std::string& prefix, std::vector<Entry>& entries) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    if (const auto* inner = node.as_table())
      flatten(*inner, key + ".", entries);
    else
      entries.push_back({key, &node});
  }
}

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

Setting setting_of(const std::string& key, const toml::node& node) {
  return {key, text_of(node), number_of(node), node.source()};
}

Settings settings_of(const toml::table& table) {
  Settings settings;
  for (const auto& [key, node] : entries_of(table)) settings.push_back(setting_of(key, *node));
  return settings;
}

const toml::table* table_at(const toml::table& root, const std::string& name, Complaints& complaints) {
  const toml::node* node = root.get(name);
  if (node == nullptr) return nullptr;
  if (!node->is_table()) complaints.add(*node, fmt::format("'{0}' must be a table; begin it with [{0}]", name));
  return node->as_table();
}

std::vector<const toml::table*> tables_at(const toml::table& root, const std::string& name, Complaints& complaints) {
  std::vector<const toml::table*> found;
  const toml::node* node = root.get(name);
  if (node == nullptr) return found;
  if (!node->is_array_of_tables()) {
    complaints.add(*node, fmt::format("'{0}' is a list of tables; begin each with [[{0}]]", name));
    return found;
  }
  for (const auto& item : *node->as_array()) found.push_back(item.as_table());
  return found;
}

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
    for (const auto& item : *list) axis.point.push_back({setting_of(entry.key, item)});
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
    for (std::size_t i = 0; i < list->size(); ++i) axis.point[i].push_back(setting_of(entry.key, (*list)[i]));
  }
  if (axis.point.empty())
    complaints.add(pairs, "[[paired]] has no key; add lists of values of scene keys");
  else
    study.axes.push_back(std::move(axis));
}

void read_cases(const std::vector<const toml::table*>& cases, Study& study) {
  Axis axis;
  for (const toml::table* each : cases) axis.point.push_back(settings_of(*each));
  if (!axis.point.empty()) study.axes.push_back(std::move(axis));
}

// A key belongs to one axis, or to [set].
void check_keys_once(const Study& study, Complaints& complaints) {
  std::set<std::string> taken;
  for (const Setting& setting : study.set) taken.insert(setting.key);
  for (const Axis& axis : study.axes) {
    std::set<std::string> own;
    for (const Settings& point : axis.point)
      for (const Setting& setting : point) {
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
    for (const Settings& point : axis.point)
      for (const Setting& setting : point) {
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

void read_work_precision(const toml::table& root, Study& study, Complaints& complaints) {
  const toml::table* table = table_at(root, "work_precision", complaints);
  if (table == nullptr) return;
  study.work_precision_at = table->source();
  WorkPrecisionSpec& spec = study.work_precision.emplace();
  read_keys(*table, "[work_precision]", work_precision_keys(), spec, complaints, {"case"});
  const toml::node* given = table->get("case");
  if (given != nullptr && !given->is_table())
    complaints.add(*given, "'case' must be a table; begin it with [work_precision.case]");
  else if (given != nullptr)
    study.reference_case = settings_of(*given->as_table());
  const auto varied = varied_keys(study);
  for (const Setting& setting : study.reference_case)
    if (std::find(varied.begin(), varied.end(), setting.key) == varied.end())
      complaints.add(setting.where,
                     fmt::format("'{}' is not varied{}", setting.key, did_you_mean(setting.key, varied)));
  if (spec.reference == "case" && study.reference_case.empty())
    complaints.add(*table, "reference = \"case\" needs [work_precision.case] with values of varied keys; add it");
  if (spec.reference == "limit" && given != nullptr)
    complaints.add(*given, "[work_precision.case] has no meaning with reference = \"limit\"; set reference = \"case\"");
  if (spec.reference == "limit" && !study.convergence)
    complaints.add(*table, "reference = \"limit\" needs [convergence]; add it, or set reference = \"case\"");
}

}  // namespace

std::vector<std::string> varied_keys(const Study& study) {
  std::vector<std::string> keys;
  for (const Axis& axis : study.axes)
    for (const Settings& point : axis.point)
      for (const Setting& setting : point)
        if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) keys.push_back(setting.key);
  return keys;
}

std::filesystem::path scene_path(const Study& study) {
  return study.file.parent_path() / study.head.scene;
}

Study read_study(const std::filesystem::path& file) {
  return read_study_text(read_text_file(file), file);
}

Study read_study_text(const std::string& text, const std::filesystem::path& name) {
  Complaints complaints(name.string());
  const toml::table root = parse_toml(text, name.string());
  Study study;
  study.file = name;
  read_keys(root, "a study file", head_keys(), study.head, complaints, tables);
  require_keys(root, "the study file", head_keys(), complaints);
  if (const toml::node* measures = root.get("measures")) study.measures_at = measures->source();
  if (const auto* set = table_at(root, "set", complaints)) study.set = settings_of(*set);
  read_cases(tables_at(root, "case", complaints), study);
  for (const auto* pairs : tables_at(root, "paired", complaints)) read_paired(*pairs, study, complaints);
  if (const auto* grid = table_at(root, "grid", complaints)) read_grid(*grid, study, complaints);
  check_keys_once(study, complaints);
  if (study.axes.empty() && complaints.count() == 0)
    complaints.add(root, "the study varies nothing; add [grid], [[paired]] or [[case]]");
  read_convergence(root, study, complaints);
  read_work_precision(root, study, complaints);
  complaints.throw_if_any();
  return study;
}

}  // namespace weaveform::study
