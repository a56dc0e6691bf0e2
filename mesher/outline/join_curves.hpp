// Curves of a drawing joined end to end into closed loops.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/outline/loops.hpp"

namespace weaveform {

struct OutlineCurve {
  std::vector<std::array<double, 2>> point;  // mm; closed when the last repeats the first
  std::string place;                         // for messages: "plate.dxf:24"; may be empty
};

// Ends within `near` (mm) of each other are one. A curve drawn twice counts once, one shorter than `near` not at all.
// Adds a line to `complaints` for ends that meet none or several others, and then returns nothing; of many of a kind
// the first are named and the rest counted. `what` names the outline, e.g. its file.
[[nodiscard]] std::vector<OutlineLoop> join_curves(std::vector<OutlineCurve> curves, double near,
                                                   const std::string& what, std::vector<std::string>& complaints);

}  // namespace weaveform
