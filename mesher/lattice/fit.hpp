// Where the yarn lines lie across the blank: as asked, or fitted to the ends of the held edges.
//
// A yarn held at one end turns with nothing but its grip, so the shear of a bias extension is set by the first yarns
// that are not held: the lines through the ends of the held edges bound the zones. In a pinned net the lattice decides
// instead: its kinematics are those of Eq. 14 with D / sqrt(2) = (L - W) / sqrt(2) replaced by the distance between the
// last line held by one grip and the last held by the other. With lines wherever the spacing puts them, that is up to
// one spacing off: measured, 36 deg at the centre became 18 with every fourth yarn modelled.
#pragma once

#include "mesher/lattice/grips.hpp"
#include "mesher/lattice/outline.hpp"

namespace weaveform::lattice {

// The fitted spacing stays within this fraction of the asked one.
constexpr double most_stretch = 0.15;
// An end of a held edge bounds a zone when lines pass on both sides of it. Else it is a tip, the blank's outermost
// point across the lines. Ends that bound come first: counting tips alike, 115 x 200 mm with every fourth yarn
// sheared 27.60 deg where Eq. 14 asks 27.93; so weighted 27.93. Tips still count, for a lattice that meets them too
// ends at a bias-cut free edge with crossings and not with stubs, which hold less: with lines a third of a spacing off
// the tips (100 x 190 mm, every fourth yarn) the angle was that of Eq. 14, the load 2 % below the ideal one.
constexpr double tip_weight = 2e-5;
// What staying at the asked spacing weighs. Both weights together move a line off an end that bounds by 0.0025 spacings
// at most: 2 d^2 <= 2 tip_weight / 4 + spacing_weight * 0.15^2 for a pair of ends and a pair of tips.
constexpr double spacing_weight = 1e-4;

// As lay_lines takes them.
struct LineLayout {
  Vec2 spacing = {0.0, 0.0};  // mm; between neighbouring crossings along u and v
  Vec2 phase = {0.0, 0.0};    // spacings; of the warp and of the weft lines
};

// For each family the spacing and phase of least
//   sum_i w_i (distance of end i to its nearest line / spacing)^2 + spacing_weight (spacing / asked - 1)^2
// over the ends of the held parts of the outline. Never a greater sum than at the asked spacing and phase 0, which is
// what comes back without grips. Symmetric when the ends are. Deterministic.
[[nodiscard]] LineLayout fit_lines(const Outline& outline, const GripRegions& grips, const Vec2& asked);

}  // namespace weaveform::lattice
