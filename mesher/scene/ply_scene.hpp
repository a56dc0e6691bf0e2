// The plies of a scene one by one.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "mesher/scene/scene.hpp"

namespace weaveform {

// The scene of one ply of a stack by itself: its fabric, blank and model, the grips that hold it, the measures that look
// at it, and everything that is the whole scene's. Its blank lies where the ply's own `position` or [blank] says; how
// high it lies on others is not known here (mesher/resolve).
[[nodiscard]] Scene scene_of_ply(const Scene& scene, std::size_t ply);

// Whether a box that is not said to hold this ply lies off its blank's bounding box of these extents (mm).
[[nodiscard]] bool lies_off(const std::array<double, 4>& box, const std::array<double, 2>& extent);

// The pair's own numbers beside the stack's: what the two plies have.
[[nodiscard]] PairSpec pair_of(const StackSpec& stack, const std::string& one, const std::string& other);

}  // namespace weaveform
