// Tools that move and never come to the blank, seen from where everything stands at the start.
#pragma once

#include <string>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {

// One line, in the words of a warning, for each tool that travels or is pushed and whose way leads past the blank at
// rest or away from it. None where a grip or weight moves the fabric, or some tool does reach it: what then meets what
// only the analysis shows. `tools` are the scene's.
[[nodiscard]] std::vector<std::string> tools_out_of_reach(const Scene& scene, const Mesh& mesh,
                                                          const std::vector<Tool>& tools);

}  // namespace weaveform
