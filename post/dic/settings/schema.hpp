// Every key of a settings file: one row each. Reader, --set and docs/dic_settings.md all follow these rows; a new key
// is a member in settings.hpp and a row in schema.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/keys/key_table.hpp"
#include "post/dic/settings/settings.hpp"

namespace weaveform::dic {

// A table of the file: how it is read, and what the reference says of it.
struct SettingsTable {
  std::string name;
  bool many = false;
  std::string doc;
  std::vector<KeyInfo> keys;
  std::function<void(const toml::node&, Settings&, Complaints&)> read;
  // Values that differ from the default, "" for the others, in the order of `keys`; empty for a list of tables.
  std::function<std::vector<std::string>(const Settings&)> given;
};

// In the order of the reference.
[[nodiscard]] const std::vector<SettingsTable>& settings_tables();

}  // namespace weaveform::dic
