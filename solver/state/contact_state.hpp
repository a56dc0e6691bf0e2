// What each node of the fabric feels of the tools at one moment, for frames.
#pragma once

#include <cstdint>
#include <vector>

namespace weaveform {

enum class FrictionState : std::uint8_t { none = 0, stick = 1, slip = 2 };

// Per node. A node touches a tool when the tool presses it: the normal force of the contact law is above zero.
struct ContactState {
  std::vector<int> tool;                // 0 none, else 1 + the scene's number of the tool that presses most
  std::vector<int> count;               // tools that touch: 2 between a die and its binder
  std::vector<double> force;            // N; normal force of `tool`
  std::vector<double> pressure;         // MPa; the same over the area of the fabric around the node
  std::vector<double> gap;              // mm; from the fabric's face to the nearest tool, negative inside it
  std::vector<FrictionState> friction;  // at `tool`: at Coulomb's limit, or below it
};

// The state of a whole fabric from that of the part that was solved: node n of the whole is the image of node
// source[n] of the part, and feels factor[n] times its force (2 for each mirror plane it lies in, which halves its mass
// and area; pressures and gaps are the same).
[[nodiscard]] ContactState unfolded(const ContactState& part, const std::vector<int>& source,
                                    const std::vector<double>& factor);

// `more` behind `all`: of the next ply of a stack.
void append(ContactState& all, const ContactState& more);

}  // namespace weaveform
