// The outline that a scene's [blank] asks for, whatever its shape.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/lattice/outline.hpp"
#include "mesher/outline/loops.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// A blank's outline as its formula, corners or file give it, read once.
struct BlankOutline {
  std::vector<OutlineLoop> loops;  // closed, in the blank's own frame (mm); none of a rectangle or a cross
  std::vector<std::string> notes;  // what a file took for granted (unit, layers), in the words of a warning
};

// Throws InputError with every complaint about the outline, FileError when blank.outline cannot be read.
[[nodiscard]] BlankOutline read_blank_outline(const Scene& scene);

// In yarn coordinates. Rectangles have edges "bottom", "right", "top", "left"; a cross is its middle square here, its
// arms are attached later (mesher/lattice/cross.hpp). `outline` is that of `blank`.
[[nodiscard]] lattice::Outline yarn_outline(const BlankSpec& blank, const BlankOutline& outline,
                                            const lattice::Turn& yarns);

// mm; extent of the blank along its own axes: blank.size, or that of the given corners or file.
[[nodiscard]] std::array<double, 2> blank_extent(const BlankSpec& blank, const BlankOutline& outline);

}  // namespace weaveform
