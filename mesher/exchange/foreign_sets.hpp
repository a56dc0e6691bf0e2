// Node sets of a foreign mesh as sets of ours.
#pragma once

#include <string>
#include <vector>

#include "mesher/exchange/foreign_mesh.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// The grips' sets first, in the scene's order (a node in two of them is the first one's), then the other sets with
// nodes of the fabric, then `outline`: what fewer than four yarn elements meet at. `ours` is the node of the mesh by
// place in the file, -1 where there is none. Adds to `notes` what is left out. Throws InputError for a grip without
// nodes, or with two sets of its name that differ.
void keep_node_sets(const ForeignMesh& file, const Scene& scene, const std::vector<int>& ours, Mesh& mesh,
                    std::vector<std::string>& notes);

}  // namespace weaveform
