// References of keys for scripts: the tables that `weaveform keys` prints, as a list.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/keys/key_info.hpp"

namespace weaveform {

// For each key an object: "key" ("blank.size"), "type" ("2 numbers"), "unit" ("" for none), "default" (its value; null
// where it is required or absent), "required", "range" ("> 0 mm"; "" when anything goes), "description".
[[nodiscard]] nlohmann::ordered_json keys_json(const std::vector<KeyInfo>& keys);

}  // namespace weaveform
