// Ties for codes that let no node be both in a multi-point constraint and under a boundary condition.
//
// A tie x = (1 - share) x_a + share x_b bears little beside a grip: the shear of a fabric's edge, or an arm's pull on a
// frame. A node under a boundary condition that a tie refers to gets a follower, a node of its own at the same place
// that a stiff spring holds to it, and the tie refers to the follower.
#pragma once

#include <vector>

#include "mesher/exchange/gathered.hpp"

namespace weaveform::foreign {

struct FreeTies {
  std::vector<MeshTie> tie;   // numbers from mesh.node_count() on are followers
  std::vector<int> follower;  // the node that each follows
  int dropped = 0;            // ties of nodes that a grip moves: the grip has them
};

[[nodiscard]] FreeTies free_ties(const Gathered& model);

}  // namespace weaveform::foreign
