// Where the tool bends more sharply than chords can follow.
#pragma once

#include <array>
#include <vector>

#include "mesher/drape/drape.hpp"
#include "mesher/drape/net.hpp"

namespace weaveform {

// Looks along every yarn element between placed crossings of the net that are `in_blank`: where the surface's normal
// turns by more than a radius of least_radius_in_cells allows, the element is halved towards the sharper half to find
// the tool's own radius (`offset` from the net). Connected elements are one place. A bend that lies between two
// crossings with equal normals, such as a bead narrower than a cell, is not seen.
[[nodiscard]] std::vector<DrapePlace> tight_bends(const DrapeSurface& surface, double offset, const DrapedNet& net,
                                                  const std::array<double, 2>& spacing,
                                                  const std::vector<char>& in_blank);

}  // namespace weaveform
