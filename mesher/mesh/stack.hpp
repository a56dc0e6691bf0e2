// The mesh of a stack: its plies' meshes one after another in one, so that whoever shows, writes or counts a mesh need
// not know of plies, and the way back to each of them.
//
// Nodes, yarn elements, cells and ties of a ply stand together, in the order of the ply's own mesh. Their lattices lie
// side by side along j, with a free row and more between them: neighbours on the lattice are neighbours in a ply.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace weaveform {

struct NamedMesh {
  std::string name;
  const Mesh* mesh;
};

// Bottom to top. A set of the stack is that of all plies that have one of its name; a frame stays with its ply.
[[nodiscard]] Mesh joined_mesh(const std::vector<NamedMesh>& plies);

// The ply's own mesh, bit for bit; of the sets those with a node in it.
[[nodiscard]] Mesh ply_mesh(const Mesh& stack, std::size_t ply);

// The entries first .. last-1 of a list with one for each node, yarn element or cell.
struct Range {
  int first = 0, last = 0;
};
[[nodiscard]] Range nodes_of_ply(const Mesh& stack, std::size_t ply);
[[nodiscard]] Range yarns_of_ply(const Mesh& stack, std::size_t ply);
[[nodiscard]] Range cells_of_ply(const Mesh& stack, std::size_t ply);

// Per node and per cell: the number of its ply, 0 in a mesh without plies.
[[nodiscard]] std::vector<int> ply_of_nodes(const Mesh& stack);
[[nodiscard]] std::vector<int> ply_of_cells(const Mesh& stack);
[[nodiscard]] std::vector<int> ply_of_yarns(const Mesh& stack);

// "" or what is wrong with the ranges of Mesh::ply, in one line.
[[nodiscard]] std::string check_plies(const Mesh& stack);

}  // namespace weaveform
