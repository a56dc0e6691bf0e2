// TOML that the program writes (scenes, defaults of keys) as JSON of the same names, in the order of the text.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace weaveform {

// Of a whole file's text: an object. Throws InputError when it is no TOML, with `name` for the file.
[[nodiscard]] nlohmann::ordered_json toml_file_json(const std::string& text, const std::string& name);

// Of one value, "[100.0, 200.0]" or "\"auto\""; null of an empty text. Throws InputError likewise.
[[nodiscard]] nlohmann::ordered_json toml_value_json(const std::string& value);

}  // namespace weaveform
