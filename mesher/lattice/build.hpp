// The yarn lattice of a flat blank, cut by its outline (replaces the paper's FORTRAN generator).
#pragma once

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/outline/blank_outline.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Lays yarns at their interval (times the coarsening, with blank.fit = "grips" shifted and stretched by up to 15 % to
// meet the ends of the held edges: fit.hpp) through the blank and merges them with shear cells.
// Kept exactly, at any yarn angle and coarsening: area = outline area; yarn length of each family = area / interval;
// mass = area * area density. Throws InputError when the blank is too small for the coarsening or a grip holds no node.
// `outline` is that of the scene's blank. A drape, if the scene has one, is laid on it later (mesher/drape/drape.hpp).
[[nodiscard]] Mesh build_flat_mesh(const Scene& scene, const Card& card, const BlankOutline& outline);

// The same from the scene and card alone, and draped where the scene says so. Throws also what read_blank_outline,
// make_tools and lay_drape throw.
[[nodiscard]] Mesh build_flat_mesh(const Scene& scene, const Card& card);
[[nodiscard]] Mesh build_mesh(const Scene& scene, const Card& card);

}  // namespace weaveform
