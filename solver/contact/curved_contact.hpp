// What contact knows of the curve between its nodes (chord_kernel.hpp has the theory): the chords at each node, and what
// each tool remembers of the step before.
#pragma once

#include <array>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "solver/contact/chord_kernel.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// Of the springs' row sums: a lift by kinks makes a node's depth p depend on its neighbours', for the kink of a node that
// moves by u grows by 2u/h and its neighbours' shrink by u/h, of both families (1 + 4/24 + 4/24).
inline constexpr double curved_stiffness = 4.0 / 3.0;

inline constexpr double curved_onset = 0.03;  // of the duration, as a pushed tool's force

class CurvedContact {
public:
  // `onset` (s): the lift grows from nothing, for a fabric that begins on a tool lies on it and not above.
  CurvedContact(const Mesh& mesh, const PackedMesh& packed, double onset);

  // mm; no node is lifted further (its chords would lie on each other).
  [[nodiscard]] double greatest_lift() const { return greatest_lift_; }

  // What one tool remembers of each packed node.
  struct Memory {
    Doubles lift;    // mm
    Doubles normal;  // N
  };
  [[nodiscard]] Memory new_memory() const;
  static void archive(Memory& memory, Archive& archive);

  // Of a block of `count` packed nodes from `first` on, the groups that have their bit in `wanted`.
  void find_turns(const State& state, int first, int count, unsigned wanted, ChordTurns& turns) const;
  // The terms of its groups at a tool; their lift is taken off the distances.
  void lift_groups(const ChordTurns& turns, double time, int first, int count, const ContactGroups& groups,
                   double friction, Distances& distances, ChordTerms& terms) const;

private:
  std::array<std::vector<int>, 2> before_, after_;  // per packed node
  std::vector<char> even_;  // per group: all neighbours that are there stand at constant distances, in the arrays
  int stride_;
  std::array<Doubles, 2> length_;  // mm; likewise
  double greatest_lift_ = 0.0;     // mm
  double onset_;                   // s
};

}  // namespace weaveform
