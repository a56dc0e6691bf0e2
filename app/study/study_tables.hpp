// Tables of a study file whose keys are those of scenes: flattened, each value with its place.
#pragma once

#include <string>
#include <vector>

#include "app/study/study_spec.hpp"
#include "core/keys/toml_document.hpp"

namespace weaveform::study {

struct Entry {
  std::string key;  // dotted
  const toml::node* node;
};

// The entries of a table whose keys may be dotted (nested tables), in the order of the file.
[[nodiscard]] std::vector<Entry> entries_of(const toml::table& table);

[[nodiscard]] Setting make_setting(const std::string& key, const toml::node& node);

// What a table says of one case: its settings, and the bare key `series` (scene keys have a dot).
[[nodiscard]] Variant variant_of(const toml::table& table, Complaints& complaints);

// root[name] as a table, as a list of tables; nullptr, or none, when it is absent or a complaint was added.
[[nodiscard]] const toml::table* table_at(const toml::table& root, const std::string& name, Complaints& complaints);
[[nodiscard]] std::vector<const toml::table*> tables_at(const toml::table& root, const std::string& name,
                                                        Complaints& complaints, const std::string& parent = "");

}  // namespace weaveform::study
