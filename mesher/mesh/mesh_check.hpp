// Whether a mesh can be computed with. What is read from a file is looked at before the solver relies on it.
#pragma once

#include <string>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

// "" for a sound mesh, else the first thing wrong with it: a number that is none or has the wrong sign, a crossing
// outside the lattice or taken twice. Lengths of arrays and indices of nodes must fit already.
[[nodiscard]] std::string what_is_wrong(const Mesh& mesh);

}  // namespace weaveform
