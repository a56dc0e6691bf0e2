// Command-line overrides of scene values, put into the parsed file before it is read.
#pragma once

#include <string>
#include <vector>

#include "core/keys/toml_document.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Puts each "key=value" into the tree: "blank.size=[100,200]", "tools.punch.travel=60", "grip.top.travel=40" or
// "grip.0.travel=40" (lists of tables by name, then by 0-based index). The value is TOML; a bare word is text. Values
// remember "--set KEY" as their source, so that later complaints about them name it. Complains about keys that lead
// nowhere and values that cannot be parsed.
void apply_overrides(toml::table& root, const std::vector<std::string>& overrides, Complaints& complaints);

// Overrides by which every blank of the scene, each ply's own too, is `factor` times as coarse as it asks.
[[nodiscard]] std::vector<std::string> coarsened(const Scene& scene, double factor);

}  // namespace weaveform
