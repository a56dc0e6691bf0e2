// Free yarn ends stay in line with their yarn (MeshTie in mesh.hpp says why).
#pragma once

#include <vector>

#include "mesher/lattice/lumping.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform::lattice {

// Ties every yarn end that no grip holds to its crossing and the crossing before, where the yarn has two. Its element
// then carries nothing (softening 0): a free end has no tension.
void tie_free_ends(Mesh& mesh, const std::vector<Hold>& hold);

}  // namespace weaveform::lattice
