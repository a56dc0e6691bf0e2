// The outline that a scene's [blank] asks for, whatever its shape.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/lattice/outline.hpp"
#include "mesher/outline/loops.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// In yarn coordinates. Rectangles have edges "bottom", "right", "top", "left"; a cross is its middle square here, its
// arms are attached later (mesher/lattice/cross.hpp). Adds a line per trouble to `complaints` and then returns an empty
// outline. Throws FileError when blank.outline cannot be read.
[[nodiscard]] lattice::Outline blank_outline(const Scene& scene, const lattice::Turn& yarns,
                                             std::vector<std::string>& complaints);

// The closed loops of a disc, polygon or file, in the blank's own frame; complaints as above.
[[nodiscard]] std::vector<OutlineLoop> blank_loops(const Scene& scene, std::vector<std::string>& complaints);

// What a file's outline took for granted (unit, layers), one line each in the words of a warning. Throws as above.
[[nodiscard]] std::vector<std::string> outline_notes(const Scene& scene);

// mm; extent of the blank along its own axes: blank.size, or that of the given corners or file.
[[nodiscard]] std::array<double, 2> blank_extent(const Scene& scene);

}  // namespace weaveform
