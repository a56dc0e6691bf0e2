// What each node of a ply feels of the others at one moment, for frames.
#pragma once

#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/symmetry/cut_part.hpp"
#include "solver/state/contact_state.hpp"

namespace weaveform {

// Per mesh node of a ply.
struct PlyContactState {
  // mm; of the node against the material of the other ply it lay on at the start, of the two faces on the one whose
  // path is longer (the upper where both are the same)
  std::vector<Vec3> slip;
  std::vector<double> slip_path;        // mm; length of its way over that material while the two touched
  std::vector<double> pressure;         // MPa; of the face where it is greater
  std::vector<int> other;               // the ply there, from 0; -1: nothing touches
  std::vector<FrictionState> friction;  // there
};

// The state of a whole ply from that of the part that was solved.
[[nodiscard]] PlyContactState unfolded(const PlyContactState& of_part, const SymmetricPart& part);

// `more` behind `all`.
void append(PlyContactState& all, const PlyContactState& more);

}  // namespace weaveform
