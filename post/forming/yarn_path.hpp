// Continuous yarns of a mesh, to be walked along from node to node.
#pragma once

#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

// The yarn elements that follow and precede each node along one family; -1: none. Free ends tied in line with their
// yarn tell nothing.
struct YarnPath {
  std::vector<int> after, before;
};

[[nodiscard]] YarnPath yarn_path(const Mesh& mesh, Family family);

}  // namespace weaveform
