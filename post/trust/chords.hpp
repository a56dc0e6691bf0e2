// Contact acts at nodes alone, so that between two nodes the fabric cuts straight through a round tool. A chord of
// length L that touches a tool of radius R with both ends has its middle at the depth
//   h = R - sqrt(R^2 - L^2/4) ,   hence   L/R = 8 q/(1 + 4 q^2) ,   q = h/L :
// the ratio that counts follows from the chord itself, whatever the tool's shape. A sharp edge counts as the radius
// whose arc has its chord and depth.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "post/forming/placed_tools.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

struct CutChord {
  int tool = -1;                                 // number of the tool that is cut; -1: none is
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  // mm; where it is deepest
  double length = 0.0, depth = 0.0;              // mm; L and h
  bool unnoticed = false;                        // no end touches: the tool pokes through between the nodes
  [[nodiscard]] double ratio() const;            // 1; L/R, at most 2, as when unnoticed
  [[nodiscard]] double radius() const;           // mm; R, infinite when nothing is cut
};

// The chord of the greatest ratio L/R; before any other one whose middle is in a tool by more than the fabric's
// thickness while no end touches that. Chords are the yarn elements, but for free ends, looked at in three places; and
// the sides of full cells, of which each counts half of the depth of the cell's middle, since on a sphere the cuts of
// both yarns add up there (what pokes through between the yarns is met there alone). The depth is that beyond the
// ends', so that the give of the contact springs does not count. With `curved`, contact lifts the ends off the tool
// (analysis.curved_contact): they touch up to lifted_share of the chord's length above it.
inline constexpr double lifted_share = 2.5 / 24.0;  // as curved_contact.cpp lifts at most
[[nodiscard]] CutChord worst_chord(const Mesh& mesh, const std::vector<Vec3>& position,
                                   const std::vector<PlacedTool>& tools, bool curved = false);

}  // namespace weaveform
