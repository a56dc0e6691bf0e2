// Nodes that follow two others (mesh.hpp, MeshTie): their forces and mass go to those two, they go where those two are.
#pragma once

#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

class Ties {
public:
  // Moves the tied nodes' mass in `packed` to what they follow: in the tie's shares, all to the first when one is
  // negative.
  Ties(const Mesh& mesh, PackedMesh& packed);
  void give_forces(State& state) const;  // f_a += (1 - share) f, f_b += share f
  void follow(State& state) const;       // positions and velocities

private:
  struct Tie {
    int node, first, second;  // packed
    double share;
  };
  std::vector<Tie> tie_;
};

// What the tied node's stiffness adds to its two nodes' bounds: |u|^2 <= first |u_a|^2 + second |u_b|^2.
//   0 <= s <= 1   first = 1 - s,              second = s            (convex)
//   s < 0         first = (1 + 2l)(1 + l),    second = (1 + 2l) l   (Cauchy), l = -s
struct TieWeights {
  double first = 0.0, second = 0.0;
};
[[nodiscard]] TieWeights tie_weights(double share);

// Adds bounds per packed node (N/mm) to those per mesh node, and those of tied nodes to what they follow.
void add_packed_bound(const Mesh& mesh, const PackedMesh& packed, const Doubles& sum, std::vector<double>& bound);

}  // namespace weaveform
