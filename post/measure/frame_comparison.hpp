// A shear frame as simulated beside the exact one: the card's own response, at the angle and the load that the test's
// evaluation makes of the travel (Eqs. 12 and 13).
#pragma once

#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

struct FrameComparison {
  double angle = 0.0;       // rad; Eq. 12 at the end; not a number past the frame's own end
  double load = 0.0;        // N; of the pulled corner at the end
  double ideal_load = 0.0;  // N; Eq. 13 inverted, of F_sh = t sigma(atanh(sin gamma)): a fabric that follows the frame.
                            // Of a stack the sum over its plies
  double worst_error = 0.0;  // 1; greatest |load/ideal - 1| from |angle| = 5 deg on; 0 when it gets not so far
};

// Of a scene with a frame, of a stack that of any of its plies, which have one size, and the cards of all. Throws
// InputError when the history has no row or lacks the frame's columns.
[[nodiscard]] FrameComparison compare_shear_frame(const Scene& scene, const std::vector<const Card*>& cards,
                                                  const History& history);

}  // namespace weaveform
