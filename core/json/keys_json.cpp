#include "core/json/keys_json.hpp"

#include <nlohmann/json.hpp>

#include "core/json/toml_json.hpp"

namespace weaveform {

nlohmann::ordered_json keys_json(const std::vector<KeyInfo>& keys) {
  auto list = nlohmann::ordered_json::array();
  for (const KeyInfo& key : keys)
    list.push_back({{"key", key.table.empty() ? key.name : key.table + "." + key.name},
                    {"type", key.type},
                    {"unit", key.unit},
                    {"default", toml_value_json(key.standard)},
                    {"required", key.required},
                    {"range", key.range},
                    {"description", key.doc}});
  return list;
}

}  // namespace weaveform
