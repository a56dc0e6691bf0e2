// Whether what the program took by itself was taken on right assumptions. Each that did not hold is a warning of the
// border it is from (borders.hpp).
#pragma once

#include <vector>

#include "post/trust/warnings.hpp"

namespace weaveform {

// Of each entry of the scene's record: of a mesh on tools, that no chord is longer than the wanted accuracy allows on
// the bend it lies on; of elements that do not bend, that nothing folds; of the duration, that inertia keeps below its
// share.
[[nodiscard]] std::vector<TakenSummary> judge_taken(const FinishedRun& run);

}  // namespace weaveform
