// The area of fabric around each node.
#pragma once

#include "mesher/mesh/mesh.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// mm^2, flat; per packed node. A cell's area goes to its nodes in equal parts. A node that follows others touches
// through them, as it has its mass in them, and has no area itself.
[[nodiscard]] Doubles node_areas(const Mesh& mesh, const PackedMesh& packed);

}  // namespace weaveform
