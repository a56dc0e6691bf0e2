// The scene as a flat list of keys and values, so that two of them can be compared by name.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/scene/scene.hpp"

namespace weaveform {

// "tools.punch.friction" and "0.3"; every key that scene_to_toml writes, in its order. Elements of a list of tables go
// by their names.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> scene_values(const Scene& scene);

}  // namespace weaveform
