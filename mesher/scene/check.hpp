// Checks that involve several keys of a scene at once: what no single row of the key table can say.
#pragma once

#include "core/keys/toml_document.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// `root` is the file the scene was read from; complaints point into it.
void check_scene(const Scene& scene, const toml::table& root, Complaints& complaints);

}  // namespace weaveform
