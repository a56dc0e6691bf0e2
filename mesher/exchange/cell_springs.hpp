// Shear cells as springs across them, for codes without a fabric law for shells.
//
// Yarns of a fabric hardly stretch, so that a cell's nodes move with g1 and g2 of unit length and s = g1.g2 between
// them: nodes dX = (dX1, dX2) apart along warp and weft on the flat fabric are
//   d^2 = dX1^2 + dX2^2 + 2 dX1 dX2 s
// apart, one and the same s for every pair. Two springs across the cell, along p = dX1 dX2 > 0 and p < 0, that pull
// with
//   F = V q(s) S(s) ds/dd = V q(s) S(s) d/p ,   s = (d^2 - dX1^2 - dX2^2)/(2 p) ,   q = 1/2 - k s ,
// S the cell's stress and k of opposite sign in the two, store the cell's energy V w(s) together, as the two q add up
// to 1: exactly, while yarns keep their length. Where both families stretch by e, s(d) errs by e (2 s + (dX1^2 +
// dX2^2)/p), upwards along the one and downwards along the other, and k = p/(dX1^2 + dX2^2) (the mean of both springs'
// sizes) makes the two errors cancel in the first order. What is left is about G e^2 a volume, G = dS/ds: springs pull
// along their line, and no set of them has G without it (Cauchy's relation). A triangle at the outline lacks the other
// diagonal; its corner A mirrored in the corner O, x_A' = 2 x_O - x_A, is a point of the same fabric and gives it.
#pragma once

#include <array>
#include <vector>

#include "mesher/exchange/gathered.hpp"
#include "mesher/exchange/laws.hpp"

namespace weaveform::foreign {

// A point of the fabric beyond a cell: x = 2 x_through - x_of.
struct MirroredNode {
  int through = 0, of = 0;
};

// Springs of the same law: pairs equally far apart on the flat fabric and at the start, that stand for the same volume.
struct CellSpringGroup {
  double along = 0.0, across = 0.0;  // mm; dX1, dX2
  double tilt = 0.0;                 // 1; k
  double volume = 0.0;               // mm^3; V, of the whole cell
  double start = 0.0;                // mm; the distance at the start of the analysis
  std::vector<std::array<int, 2>> node;
};

struct CellSprings {
  std::vector<CellSpringGroup> group;
  std::vector<MirroredNode> mirrored;  // nodes after the mesh's own
};

// Two for every cell. Throws InputError for a cell whose nodes do not lie across it.
[[nodiscard]] CellSprings cell_springs(const Gathered& model);

// Force (N) over elongation from the start (mm), in at most `most` points: to 15 deg beyond the shear angle that the
// law is meant for, at least 75 deg.
[[nodiscard]] Points spring_points(const Gathered& model, const CellSpringGroup& group, std::size_t most);

}  // namespace weaveform::foreign
