// Whether a plane mirrors a whole mesh onto itself: every node, yarn element, cell, tie and node set onto one like it.
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

// The number of each thing's image; a plane mirrors twice back to the start, so each list is its own inverse.
struct MirrorMap {
  std::vector<int> node, yarn, cell;
  std::vector<int> set;         // as Mesh::sets
  bool swaps_families = false;  // warp yarns are mirrored onto weft yarns
};

// Places must agree to this fraction of the spacing, everything else to the second. The lattice is laid out to 1e-7.
inline constexpr double mirror_place_tolerance = 1e-6;
inline constexpr double mirror_value_tolerance = 1e-6;

// Fills `map`. Returns "" when the plane is one of the mesh, else the first thing that has no image, in words.
[[nodiscard]] std::string find_mirror_map(const Mesh& mesh, const SymmetryPlane& plane, MirrorMap& map);

}  // namespace weaveform
