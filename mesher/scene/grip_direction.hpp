// The direction a grip travels in.
#pragma once

#include <array>

#include "mesher/scene/scene.hpp"

namespace weaveform {

// Unit vector, blank frame: the outward normal of the grip's edge, or (0, 1, 0) for a box, unless the scene says
// otherwise.
[[nodiscard]] std::array<double, 3> grip_direction(const GripSpec& grip);

}  // namespace weaveform
