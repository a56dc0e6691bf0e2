// The fields of all plies of a scene, one or a stack.
#pragma once

#include "mesher/resolve/resolved.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

// compute_fields of each ply by its own card and model; `position` of the whole mesh's nodes.
[[nodiscard]] Fields compute_fields(const Resolved& model, double time, const std::vector<Vec3>& position);

}  // namespace weaveform
