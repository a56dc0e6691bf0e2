// The flat outline of what a drape covers: what to cut from the roll.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mesher/drape/drape.hpp"

namespace weaveform {

// Closed loops in the blank's frame (mm), fabric on the left. They join the ends of the yarns: on the blank's outline,
// or where the yarn leaves the tool's surface (found by halving along the yarn, so exact there); corners between two
// yarns are cut straight.
using FlatPattern = std::vector<std::vector<std::array<double, 2>>>;
[[nodiscard]] FlatPattern flat_pattern(const Scene& scene, const Mesh& flat_mesh, const std::vector<Tool>& tools,
                                       const Drape& drape);

// "loop,x_mm,y_mm" and a line a point; loops count from 0 and close by themselves.
[[nodiscard]] std::string flat_pattern_csv(const FlatPattern& pattern);

// mm^2; holes count against it.
[[nodiscard]] double pattern_area(const FlatPattern& pattern);

}  // namespace weaveform
