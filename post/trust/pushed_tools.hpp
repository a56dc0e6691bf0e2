// Whether a tool that is pushed by a force gives that force to the fabric. With its mass m and the guide's damping c,
//   m a = F - N - c m v :
// the fabric feels N, which lags behind F where c m is large against the stiffness of what the tool stands on, and
// swings about it where m is large and c small.
#pragma once

#include <vector>

#include "mesher/scene/scene.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct PushedTool {
  int tool = -1;                             // number in the scene
  double off = 0.0;                          // 1; greatest |N - F|/F
  double time = 0.0, felt = 0.0;             // s, N; when, and N then
  double viscous = 0.0;                      // N; c m v then
  double share_off = 0.0, share_free = 0.0;  // 1; of the time: off by more than `border`, and without contact
};

// Of each pushed tool, in the rows after twice the onset of the force (tool_motion.hpp); where nothing in the scene
// travels, so that the pushed tools alone form the fabric and their way is a motion of its own, in the last row only.
// `free_mass` (tonne) is that of a tool that names none. Throws InputError when the history lacks a column.
[[nodiscard]] std::vector<PushedTool> pushed_tools(const Scene& scene, const History& history, double free_mass,
                                                   double border);

}  // namespace weaveform
