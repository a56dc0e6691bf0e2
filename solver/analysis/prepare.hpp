// What an analysis is made of, from a resolved scene: the mass it moves, and the part of the blank it solves.
#pragma once

#include <vector>

#include "mesher/resolve/resolved.hpp"
#include "mesher/symmetry/cut_part.hpp"

namespace weaveform {

// The fabric with analysis.mass_scale times its mass; loading.cpp and gravity.cpp leave it out again, for durations are
// chosen by the real mass and weight is the real weight.
[[nodiscard]] Resolved with_scaled_mass(Resolved model);

// The half or quarter of each ply's mesh that is solved for the whole; empty: the whole is.
[[nodiscard]] std::vector<SymmetricPart> parts_to_solve(const Resolved& model);

}  // namespace weaveform
