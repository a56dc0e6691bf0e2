// A tool's surface as a mesh of rigid shells, for codes whose rigid walls lack its shape. Surfaces that go on for ever
// end where the fabric cannot get to.
#pragma once

#include <array>
#include <vector>

#include "mesher/exchange/gathered.hpp"

namespace weaveform::foreign {

// mm; greatest distance of a facet from the true surface, half of it from its chords along each of two directions
inline constexpr double tool_sagitta = 0.2;

struct ToolMesh {
  std::vector<std::array<double, 3>> node;  // mm; world, at the start
  std::vector<std::array<int, 4>> face;     // counter-clockwise from outside; [3] = -1: a triangle
};

[[nodiscard]] ToolMesh mesh_of_tool(const Gathered& model, const ToolMotion& motion);

}  // namespace weaveform::foreign
