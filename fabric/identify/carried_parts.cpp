#include "fabric/identify/carried_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"

namespace weaveform::identify {
namespace {

// Tests make these; what an older card says of them is past.
const std::vector<std::string> measured_tension = {"tension", "linear_modulus", "valid_to", "compression_modulus"};
const std::vector<std::string> measured_bending = {"rigidity", "bending_out_of_plane", "bending_out_of_plane_back"};
// Given once: by one key or by the others.
const std::vector<std::vector<std::string>> alternatives = {{"section", "fibre_volume_fraction"},
                                                            {"section", "fibre_density"},
                                                            {"section", "matrix_density"},
                                                            {"compression", "compression_modulus"}};

bool one_of(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

template <class Spec>
bool is_given(const Key<Spec>& key, const Spec& spec) {
  const auto value = key.write(spec);
  return value && *value != "\"auto\"";
}

// Whether `spec` gives what `name` would give in another way.
template <class Spec>
bool has_alternative(const std::vector<Key<Spec>>& keys, const Spec& spec, const std::string& name) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key<Spec>& key) {
    return key.rule.name != name && is_given(key, spec) &&
           std::any_of(alternatives.begin(), alternatives.end(),
                       [&](const auto& pair) { return one_of(pair, name) && one_of(pair, key.rule.name); });
  });
}

// `old` beside `spec`: keys only the old has are taken, those that differ are told.
template <class Spec>
void carry_table(const std::vector<Key<Spec>>& keys, const Spec& old, const toml::table& table,
                 const std::string& title, const std::vector<std::string>& measured, Spec& spec,
                 std::vector<std::string>& said) {
  std::vector<std::string> taken;
  Complaints none("card");
  const Spec before = spec;
  for (const Key<Spec>& key : keys) {
    const std::string& name = key.rule.name;
    const toml::node* node = table.get(name);
    if (node == nullptr || !is_given(key, old) || one_of(measured, name)) continue;
    if (!is_given(key, before)) {
      if (has_alternative(keys, before, name)) {
        said.push_back(
            fmt::format("the card that is replaced has '{}' in {}, for which this fit gives another key; if "
                        "the old was meant, write it into the fit file",
                        name, title));
        continue;
      }
      key.read(*node, key.rule, spec, none);
      taken.push_back(name);
    } else if (*key.write(old) != *key.write(before)) {
      said.push_back(fmt::format(
          "the card that is replaced has {} = {} in {}, this fit gives {}; if the old value was meant, write "
          "it into the fit file",
          name, *key.write(old), title, *key.write(before)));
    }
  }
  if (!taken.empty())
    said.push_back(
        fmt::format("carried over from the card that is replaced: {} of {}; write them into the fit file or "
                    "its base card to keep them there",
                    fmt::join(taken, ", "), title));
}

// The family's own table over the common one.
toml::table family_table(const toml::table& root, const std::string& family) {
  toml::table merged;
  const toml::table* yarn = root["yarn"].as_table();
  if (yarn == nullptr) return merged;
  for (const auto& [name, node] : *yarn)
    if (name.str() != yarn_families[0] && name.str() != yarn_families[1]) merged.insert_or_assign(name, node);
  if (const toml::table* own = (*yarn)[family].as_table())
    for (const auto& [name, node] : *own) merged.insert_or_assign(name, node);
  return merged;
}

}  // namespace

std::vector<std::string> carry_typed_parts(const std::string& replaced, const std::string& file, bool bending_measured,
                                           CardParts& parts) {
  std::vector<std::string> said, measured = measured_tension;
  if (bending_measured) measured.insert(measured.end(), measured_bending.begin(), measured_bending.end());
  try {
    (void)read_card_text(replaced, file);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}; this card would be replaced and what was typed into it lost: correct it, or move "
                    "it away",
                    error.complaints().front()));
  }
  const toml::table root = parse_toml(replaced, "card.toml");
  Complaints none("card.toml");
  for (std::size_t f = 0; f < yarn_families.size(); ++f) {
    const toml::table table = family_table(root, yarn_families[f]);
    YarnFile old;
    read_keys(table, "[yarn]", yarn_keys(), old, none);
    carry_table(yarn_keys(), old, table, "[yarn." + yarn_families[f] + "]", measured, parts.yarn[f], said);
  }
  if (const toml::table* table = root["bending"].as_table()) {
    BendingCard old;
    read_keys(*table, "[bending]", bending_keys(), old, none);
    carry_table(bending_keys(), old, *table, "[bending]", measured, parts.bending, said);
  }
  return said;
}

}  // namespace weaveform::identify
