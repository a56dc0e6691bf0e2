// The shear-frame specimen (paper, Fig. 4): a square of fabric whose yarns run on through arms, the cross yarns there
// being removed, to the members of a pin-jointed frame of side L_F.
#pragma once

#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "mesher/lattice/fit.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform::lattice {

// Complains unless the blank is a square with yarns along its sides, smaller than the frame, and without grips of its
// own.
void check_frame(const Scene& scene, std::vector<std::string>& complaints);

// Adds to a finished mesh of the square: an arm element from the end of each yarn to its member (one element: a chain
// of pinned pieces without cross yarns would be a mechanism), the ties that hold the arms' ends on the members, and the
// four corners. The pulled corner lies along the first quadrant's diagonal of the blank's frame: pulling it shears
// positively.
void attach_frame(const Scene& scene, const Card& card, Mesh& mesh);

}  // namespace weaveform::lattice
