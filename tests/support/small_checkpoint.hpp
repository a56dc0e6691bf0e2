// A run as small as a run can be, for tests of checkpoint files: what it is of, and what fits it.
#pragma once

#include "solver/analysis/checkpoint.hpp"

namespace weaveform::test {

inline const Identity small_identity = {{"blank.size", "[1, 2]"}, {"card twintex-pw", "00ff", true}};
inline const CheckpointSizes small_sizes = {.nodes = 3,
                                            .grips = 2,
                                            .columns = 4,
                                            .rows = 5,
                                            .frames = 3,
                                            .impulses = 2,
                                            .path_cells = 2,
                                            .fabric = 5,
                                            .term = {2, 1},
                                            .duration = 1.0};

}  // namespace weaveform::test
