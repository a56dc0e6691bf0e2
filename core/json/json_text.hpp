// JSON as Weaveform writes it: files and printed answers alike.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace weaveform {

// The whole document, indented by two, with a line end. What is no UTF-8 (a file's name, a header of somebody else's)
// becomes U+FFFD; a number that is not finite is null.
[[nodiscard]] std::string json_text(const nlohmann::ordered_json& json);

}  // namespace weaveform
