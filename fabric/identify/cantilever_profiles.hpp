// Digitised shapes of strips that hang from a clamp: read, put in order from the clamp to the tip, and each brought to
// the moment-curvature curve that it shows (hanging_strip.hpp).
#pragma once

#include <vector>

#include "fabric/identify/bending_tests.hpp"

namespace weaveform::identify {

// Curves of a [[cantilever]]. What can be put right is and is noted: rows from the tip to the clamp, strips that hang
// towards negative x, points in the jaws. Throws InputError, for all files at once: a profile that crosses itself, one
// of a longer overhang that hangs above a shorter one's, lengths that the overhangs contradict (units), heights that
// count downwards, shapes of nothing that hangs.
[[nodiscard]] std::vector<BendingSpecimen> cantilever_specimens(const TestSpec& test, const FitSpec& spec);

}  // namespace weaveform::identify
