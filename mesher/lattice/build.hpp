// The yarn lattice of a flat blank, cut by its outline (replaces the paper's FORTRAN generator).
#pragma once

#include "fabric/card/card.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

// Lays yarns at their interval (times the coarsening, with blank.fit = "grips" shifted and stretched by up to 15 % to
// meet the ends of the held edges: fit.hpp) through the blank and merges them with shear cells.
// Kept exactly, at any yarn angle and coarsening: area = outline area; yarn length of each family = area / interval;
// mass = area * area density. Throws InputError when the blank is too small for the coarsening or a grip holds no node.
// With [drape] the mesh starts draped (mesher/drape/drape.hpp, which says what else is thrown).
[[nodiscard]] Mesh build_mesh(const Scene& scene, const Card& card);

// The same before any drape.
[[nodiscard]] Mesh build_flat_mesh(const Scene& scene, const Card& card);

}  // namespace weaveform
