// How far a blank without tools has left its plane, and whether it has folded from cell to cell.
//
// A yarn zigzags where it turns out of the fabric's plane one way at a crossing and the other way at the next: a fold
// no longer than two cells, whose length is therefore the mesh's and not the fabric's. With turns p, q of opposite sign
// at the ends of an element of length L,
//   height = L/2 min(|p|, |q|),
// which is the height of crest over trough, 2 a, of z = a (-1)^n (turns 4 a/L). A wave that its cells resolve (eight a
// wave or more) has turns of one sign but at its inflections, where they vanish: 6 % of its height at most is found.
#pragma once

#include <optional>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

struct Folds {
  double out_of_plane = 0.0;   // mm; greatest distance of a node from the plane of the flat blank
  double zigzag_height = 0.0;  // mm; greatest
  double zigzag_share = 0.0;   // 1; of the area, at nodes where yarns zigzag by more than the fabric's thickness
};

// `position` in mm, per node. None for a scene with tools: there wrinkles.hpp has the measure, for tools bend fabric
// from cell to cell without any fold.
[[nodiscard]] std::optional<Folds> find_folds(const Scene& scene, const Mesh& mesh, const std::vector<Vec3>& position);

}  // namespace weaveform
