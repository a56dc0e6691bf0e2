// The one way from a scene to what it leads to (resolved.hpp), in the order in which one thing needs another: scene,
// card, outline, what the scene leaves open (mesher/automatic), flat mesh, tools, drape, symmetry.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/findings.hpp"
#include "mesher/resolve/resolved.hpp"

namespace weaveform {

// What a caller wants looked at on the way; whatever these throw is a finding like any other.
struct ResolveChecks {
  std::function<void(const Scene&, const Card&)> of_card = {};                       // once the card is read
  std::function<void(const Scene&, const Card&, const BlankOutline&)> of_size = {};  // before the mesh is made
};

enum class ResolveTo {
  whole,  // all of it
  flat,   // the mesh before any drape, and no symmetry: for who drapes it
};

// Goes as far as it can; what does not stand in the way of the rest is left out of it and found (`found`): tools that
// cannot be made, a card that cannot be read. The result is whole when nothing was found; its mesh has no cells when
// none could be made. Throws InputError when the scene itself is wrong, and what `found` lets through.
[[nodiscard]] Resolved resolve(const std::filesystem::path& scene_file, const std::vector<std::string>& overrides,
                               Findings& found, const ResolveChecks& checks = {}, ResolveTo to = ResolveTo::whole);

// The same for the scene, card and mesh that are there already (a folder's, another program's). Throws what
// read_blank_outline, make_tools and find_symmetry throw. Of a stack, `mesh` is that of all plies, and each has the card
// that it names.
[[nodiscard]] Resolved resolve_around(Scene scene, Card card, Mesh mesh);

// The scene without the random start of analysis.perturbation, which may make it symmetric.
[[nodiscard]] Resolved without_perturbation(const Resolved& model);

}  // namespace weaveform
