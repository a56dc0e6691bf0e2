// What lies between a node's neighbours along its yarns: a along the warp, b along the weft. The node's normal is that of
// a x b, its shear angle that between them (ply_face.hpp, sheared_thickness.hpp).
#pragma once

#include <array>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// A node's neighbours: a leads from west to east, b from south to north. At the end of a yarn one of the two is the node
// itself.
struct NodeArms {
  std::array<int, 4> arm;  // packed: west, east, south, north
};
// Of each packed node; nodes that do not exist have arms of no length.
[[nodiscard]] std::vector<NodeArms> node_arms(const Mesh& mesh, const PackedMesh& packed);
// The same along whole yarn elements only, from crossing to crossing. A node that lacks those of a family takes its
// neighbour's, a yarn end all of its crossing's: so that the angle between a and b is one of cells, not of the short ends
// that an outline leaves.
[[nodiscard]] std::vector<NodeArms> whole_arms(const Mesh& mesh, const PackedMesh& packed);

class PlyArms {
public:
  PlyArms(const Mesh& mesh, const PackedMesh& packed, const Components& start, std::vector<NodeArms> arms);

  [[nodiscard]] const NodeArms& of(int packed) const { return arms_[packed]; }
  [[nodiscard]] bool in_a_plane(int packed) const { return !flat_[packed].empty(); }  // that mirrors the ply
  // a and b; in a mirror plane as both sides have them.
  [[nodiscard]] std::array<Vec3, 2> between(int packed, const Components& position) const;
  // Adds the forces G_a at the ends of a, G_b at those of b (N): + east and north, - west and south.
  void add_levers(int packed, std::array<Vec3, 2> lever, Components& force) const;

private:
  // A mirror plane that a node lies in. Its yarns run along or across the plane (swaps 0), or it mirrors each family onto
  // the other (1 where a warp's image runs as the weft does, -1 where against it).
  struct InPlane {
    Vec3 normal;
    double swaps;
  };
  void find_planes(const Mesh& mesh, const PackedMesh& packed, const Components& start);
  [[nodiscard]] std::array<Vec3, 2> between_arms(int packed, const Components& position) const;

  std::vector<NodeArms> arms_;
  std::vector<std::vector<InPlane>> flat_;  // per packed node
};

}  // namespace weaveform
