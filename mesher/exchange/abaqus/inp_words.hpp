// What input files for Abaqus and for CalculiX have in common. Both read at most 20 characters of a number, so the exact
// values stand in the weaveform lines.
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform::foreign {

[[nodiscard]] std::string num(double value);
void add_nodes(const Mesh& mesh, std::string& out);
// Nodes counted from 0; nothing of an empty set.
void add_node_set(const std::string& name, const std::vector<int>& nodes, std::string& out);

}  // namespace weaveform::foreign
