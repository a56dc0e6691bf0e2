// How many yarns each chord of the net stands for, so that the blank's yarn length comes out exactly.
#pragma once

#include "mesher/lattice/net.hpp"
#include "mesher/lattice/outline.hpp"

namespace weaveform::lattice {

// A line stands for the strip half a spacing to either side of it. With A the area inside the outline that a chord
// stands for and L the length of its elements, the chord holds
//   yarns = A / (interval L) ,   so that   sum(yarns L) = outline area / interval   for each family.
// Where a strip reaches past the end of its chord by more than half a spacing (at edges nearly along the yarns), or has
// no chord with elements at all, its area goes to the chord that lies nearest to it there. interval (mm): between
// neighbouring yarns of the family. Sets Chord::yarns.
void share_strips(YarnNet& net, const Outline& outline, const Vec2& interval);

}  // namespace weaveform::lattice
