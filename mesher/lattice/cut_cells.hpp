// Shear cells of the net: whole quads inside, polygons of crossings and yarn ends where the outline cuts them.
#pragma once

#include "mesher/lattice/net.hpp"
#include "mesher/lattice/outline.hpp"
#include "mesher/mesh/mesh.hpp"

namespace weaveform::lattice {

// A cut cell whose nodes pin down the deformation gradient too weakly is merged into the nearest cell: the least
// eigenvalue of its nodes' scatter, in units of the spacing, must reach this (0.01 for a quad of 0.1 spacings' height).
constexpr double least_scatter = 0.004;

// The areas add up to the outline's area. lattice is in the numbering of net.grid; cut cells may start at -1.
[[nodiscard]] MeshCells cut_cells(const YarnNet& net, const Outline& outline);

}  // namespace weaveform::lattice
