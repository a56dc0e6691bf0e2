// A table of keys: one row per key of a plain struct drives its reader, its echo and its reference page, so that the
// three cannot drift apart. A row is
//     key<&BlankSpec::size>({.name = "size", .unit = "mm", .limits = above(0), .doc = "extent along x and y"})
// and defaults are those of the default-constructed struct, never repeated here.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "core/keys/choice_value.hpp"
#include "core/keys/key_info.hpp"
#include "core/keys/key_value.hpp"
#include "core/keys/nearest_name.hpp"
#include "core/keys/toml_document.hpp"

namespace weaveform {

template <class Spec>
struct Key {
  KeyRule rule;
  std::string type;
  std::function<void(const toml::node&, const KeyRule&, Spec&, Complaints&)> read;
  std::function<TomlText(const Spec&)> write;
};

namespace detail {
template <class Spec, class Value>
Spec owner_of(Value Spec::*);
}  // namespace detail

// The row of a member: type, reader and writer follow from the member itself, and of a choice its words.
template <auto member>
[[nodiscard]] auto key(KeyRule rule) {
  using Spec = decltype(detail::owner_of(member));
  const auto words = type_words(Spec{}.*member);
  if (rule.allowed.empty()) rule.allowed = allowed_words(Spec{}.*member);
  const auto type = rule.one_for_all ? "a number or " + words : words;
  return Key<Spec>{std::move(rule), type,
                   [](const toml::node& node, const KeyRule& about, Spec& spec, Complaints& complaints) {
                     read_value(node, about, spec.*member, complaints);
                   },
                   [](const Spec& spec) { return toml_text(spec.*member); }};
}

// The same for a key that may be "auto": `open` is then set beside the member, which somebody else gives its value.
template <auto member, auto open>
[[nodiscard]] auto key_or_auto(KeyRule rule) {
  using Spec = decltype(detail::owner_of(member));
  rule.or_auto = true;
  auto row = key<member>(std::move(rule));
  if (row.rule.allowed.empty())
    row.type += " or \"auto\"";
  else
    row.rule.allowed.emplace_back("auto");
  row.read = [read = row.read](const toml::node& node, const KeyRule& about, Spec& spec, Complaints& complaints) {
    spec.*open = node.value<std::string>() == "auto";
    if (!(spec.*open)) read(node, about, spec, complaints);
  };
  row.write = [write = row.write](const Spec& spec) { return spec.*open ? TomlText("\"auto\"") : write(spec); };
  return row;
}

// The rows of a part of a struct as rows of the whole struct.
template <auto part, class Part>
[[nodiscard]] auto keys_of_part(const std::vector<Key<Part>>& keys) {
  using Spec = decltype(detail::owner_of(part));
  std::vector<Key<Spec>> whole;
  for (const auto& key : keys)
    whole.push_back({key.rule, key.type,
                     [read = key.read](const toml::node& node, const KeyRule& about, Spec& spec,
                                       Complaints& complaints) { read(node, about, spec.*part, complaints); },
                     [write = key.write](const Spec& spec) { return write(spec.*part); }});
  return whole;
}

template <class Spec>
[[nodiscard]] std::vector<std::string> key_names(const std::vector<Key<Spec>>& keys) {
  std::vector<std::string> names;
  for (const auto& key : keys) names.push_back(key.rule.name);
  return names;
}

// Reads every key the table has; unknown ones are complaints. `also` names keys that someone else reads.
template <class Spec>
void read_keys(const toml::table& table, const std::string& title, const std::vector<Key<Spec>>& keys, Spec& spec,
               Complaints& complaints, const std::vector<std::string>& also = {}) {
  for (const auto& [name, node] : table) {
    const auto same_name = [&given = name](const Key<Spec>& key) { return key.rule.name == given.str(); };
    const auto found = std::find_if(keys.begin(), keys.end(), same_name);
    if (found != keys.end()) {
      found->read(node, found->rule, spec, complaints);
    } else if (std::find(also.begin(), also.end(), name.str()) == also.end()) {
      auto valid = key_names(keys);
      valid.insert(valid.end(), also.begin(), also.end());
      // A key set on the command line has no place of its own, its value has.
      complaints.add(name.source().begin.line > 0 ? name.source() : node.source(),
                     "unknown key '" + std::string(name.str()) + "' in " + title + did_you_mean(name.str(), valid));
    }
  }
}

// Complains about required keys that neither the table nor the one it falls back on has.
template <class Spec>
void require_keys(const toml::table& table, const std::string& title, const std::vector<Key<Spec>>& keys,
                  Complaints& complaints, const toml::table* fallback = nullptr) {
  for (const auto& key : keys) {
    if (!key.rule.required || table.contains(key.rule.name)) continue;
    if (fallback != nullptr && fallback->contains(key.rule.name)) continue;
    const std::string unit = key.rule.unit.empty() || key.rule.unit == "1" ? "" : " (" + key.rule.unit + ")";
    complaints.add(table, title + " lacks the required key '" + key.rule.name + "'; add " + key.rule.name + " = " +
                              key.type + unit);
  }
}

// Whether an echo shows values left to the program as "auto", or only those that are given.
enum class Echo { all, given };

// "key = value  # unit" lines of every key that is present.
template <class Spec>
[[nodiscard]] std::string write_keys(const std::vector<Key<Spec>>& keys, const Spec& spec, Echo echo = Echo::all) {
  std::string text;
  for (const auto& key : keys) {
    const auto value = key.write(spec);
    if (!value || (echo == Echo::given && *value == "\"auto\"")) continue;
    text += key.rule.name + " = " + *value;
    if (!key.rule.unit.empty() && key.rule.unit != "1") text += "  # " + key.rule.unit;
    text += "\n";
  }
  return text;
}

template <class Spec>
[[nodiscard]] std::vector<KeyInfo> describe_keys(const std::string& table, const std::vector<Key<Spec>>& keys) {
  std::vector<KeyInfo> infos;
  for (const auto& key : keys) {
    const auto standard = key.rule.required ? TomlText{} : key.write(Spec{});
    infos.push_back({table, key.rule.name, key.type, key.rule.unit, standard.value_or(""), range_words(key.rule),
                     key.rule.required, key.rule.doc});
  }
  return infos;
}

}  // namespace weaveform
