// The bends of a mesh: at every crossing, the elements before and after it along each continuous yarn, which turn
// against each other there. Crossings are pins for the two families: each bends by itself, so that bending never
// resists trellis shear.
#pragma once

#include <array>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform {

// One family at one crossing. The yarn's curvature is the turn between its two elements over `spread`, the length that
// this bend stands for: half of both elements. Where a grip clamps the yarn, `fixed` is its direction in the jaws in
// place of one element's, and half of the other is the spread; the fabric's normal there is that of both directions.
// At an edge oblique to the yarn its moment does not vanish. The last bend before such an end bears the energy of the
// rest of its yarn as well, as if there were more `yarns`; without it strips cut at 45 deg are too soft by a part of
// first order in the spacing. At an edge across the family alone the moment vanishes, and the rest bears nothing.
struct YarnBend {
  int before = -1, after = -1;  // mesh nodes; the crossing itself where there is no element
  double yarns = 0.0;           // 1; that bend here; 0: this family does not
  double spread = 0.0;          // mm
  bool fixed_before = false, fixed_after = false;
  Vec3 fixed = {0.0, 0.0, 0.0};  // unit
};

struct Bend {
  int node = -1;
  std::array<YarnBend, 2> yarn;  // warp, weft
};

// `held`: per mesh node, true where a grip holds every component and does not turn: yarns are clamped there. Free yarn
// ends that are tied in line with their yarn take no part.
[[nodiscard]] std::vector<Bend> find_bends(const Mesh& mesh, const std::vector<char>& held);

}  // namespace weaveform
