// The mirror planes of a half or quarter (mesher/mesh/symmetry.hpp) in motion: nodes in a plane stay in it, nodes
// beyond one go as their images do, and what pulls at them pulls at those.
#pragma once

#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

class MirrorPlanes {
public:
  // After the ties: mass that they gave to images goes to the nodes themselves.
  MirrorPlanes(const Mesh& mesh, PackedMesh& packed);
  // The force on an image, mirrored back, acts on the node itself. Before and after forces go from tied nodes to
  // others.
  void give_forces(State& state) const;
  // Takes out what presses nodes against their plane: the other side presses back. After all forces are given.
  void hold(State& state) const;
  // Positions and velocities of the images. Before and after tied nodes follow theirs.
  void follow(State& state) const;

private:
  struct Image {
    int node, of;  // packed
    unsigned planes;
    std::array<double, 3> start;  // mm; of the node beyond the plane
    std::array<double, 3> start_of;
  };
  using Reflection = std::array<Vec3, 3>;  // rows of a matrix

  std::vector<SymmetryPlane> plane_;
  std::vector<Reflection> reflection_;      // by the set of planes
  std::vector<std::vector<int>> on_plane_;  // packed
  std::vector<Image> image_;
};

}  // namespace weaveform
