// Who bends with what stiffness: the card's numbers and the scene's choice of elements, resolved.
#pragma once

#include <array>

#include "fabric/card/card.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Moment-curvature laws per yarn (N mm against 1/mm; a cell's is its rigidity times the yarn interval) and twist per
// width. A law without pieces bears nothing. Here the sense of a law out of the plane is told by the mesh: its `face` half
// holds where the side of the mesh's normal (warp x weft) is bent outwards, whichever side of the fabric that is.
struct Flexure {
  std::array<TangentLaw, 2> in_plane;      // of beams
  std::array<BendingLaw, 2> out_of_plane;  // of beams and of rotation-free cells
  std::array<BendingLaw, 2> shell;         // of shell cells, out of plane
  // Friction beside those laws, per yarn; moments of 0: none. Where beams and shell cells bend, the beams have it.
  std::array<BendingFriction, 2> friction_in_plane, friction_out_of_plane, friction_shell;
  double twist = 0.0;             // N mm; of rotation-free and shell cells
  double transverse_shear = 0.0;  // N/mm; of shell cells
  bool bends_yarns = false;       // any law or friction of in_plane and out_of_plane
  bool rotation_free = false, has_shell = false;
};

// rad; that the stable step is bounded up to: a yarn folded flat at one crossing.
inline constexpr double greatest_turn = 3.2;

// Beams take model.yarn_bending, or the card's two laws. Cells that bend take model.cell_bending, or the card's
// rigidity less the initial stiffness of the beams, if any, or (with yarns that do not bend) the card's yarn law out of
// plane. A card's two senses are turned over with the fabric, where `fabric.face` looks down. Friction is
// model.bending_friction or the card's, once for every yarn whatever bends. Throws InputError when a number is needed that
// neither the scene nor the card gives, and for a shell without bending stiffness along its yarns: its rotations would be
// free to alternate.
[[nodiscard]] Flexure choose_flexure(const Card& card, const Scene& scene);

// Whether anything that bends has friction.
[[nodiscard]] bool has_friction(const Flexure& flexure);

// Throws InputError for friction of beams or rotation-free cells that act at every `every`-th step only
// (analysis.bending_every).
void refuse_friction_in_impulses(const Flexure& flexure, int every);

}  // namespace weaveform
