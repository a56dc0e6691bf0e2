// The half or quarter of a symmetric mesh that is solved, and the way back to the whole.
#pragma once

#include <vector>

#include "mesher/symmetry/find_symmetry.hpp"

namespace weaveform {

// A node of the whole as the image of a node of the part in every plane whose bit is set.
struct PartImage {
  int node = 0;
  unsigned planes = 0;
};

struct SymmetricPart {
  Mesh mesh;                     // the side the planes' normals point to; mesh.symmetry says how it goes on
  std::vector<PartImage> image;  // per node of the whole
};

// `symmetry` has at least one plane and is that of `whole`. With `run_on` every yarn that meets a plane runs on by one
// element beyond it, for forces that look at neighbours: without section, for it is counted on this side.
[[nodiscard]] SymmetricPart cut_part(const Mesh& whole, const Symmetry& symmetry, bool run_on = false);

// Positions (mm) of the whole's nodes from those of the part's: the start plus the mirrored displacement.
[[nodiscard]] std::vector<std::array<double, 3>> unfold(const SymmetricPart& part, const Mesh& whole,
                                                        const std::vector<std::array<double, 3>>& position);

}  // namespace weaveform
