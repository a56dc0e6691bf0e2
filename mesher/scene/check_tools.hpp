// Checks of [tools.NAME] that involve several keys: what a shape needs and what means nothing to it, motion or force.
#pragma once

#include "core/keys/toml_document.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// `root` is the file the scene was read from; complaints point into it.
void check_tools(const Scene& scene, const toml::table& root, Complaints& complaints);

// Where a key stands, or its table when the key is not given.
[[nodiscard]] const toml::node& place_of(const toml::table& table, const char* key);

}  // namespace weaveform
