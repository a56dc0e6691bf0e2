// Whether what a scene does to the blank is the same on both sides of a plane: laws, gravity, grips, tools.
#pragma once

#include <string>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/symmetry/mirror_map.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

// The plane through the blank's centre across its own axis x (0) or y (1).
[[nodiscard]] SymmetryPlane blank_plane(const BlankSpec& blank, int axis);

// `tools` are the scene's. "" or the first thing that differs on the two sides of the plane across `axis`, in words.
//   grips  each is mirrored onto itself or onto another one with the mirrored direction, the same travel and freedoms
//   tools  each is its own image; one that moves does so along the plane. Triangles are never taken for symmetric.
[[nodiscard]] std::string find_load_difference(const Scene& scene, const std::vector<Tool>& tools, int axis);

// The same for the fabric's laws, where `map` of the mesh mirrors warp yarns onto weft yarns.
[[nodiscard]] std::string find_law_difference(const Scene& scene, const Card& card, const MirrorMap& map);

}  // namespace weaveform
