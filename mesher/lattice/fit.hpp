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
// A tip is an end of a held edge that is the blank's outermost point across the lines: no line passes beyond it, so no
// zone border hangs on it, and a line there only makes tidier strips. It weighs this much beside an end that bounds.
constexpr double tip_weight = 0.02;
// What staying at the asked spacing weighs: cost of a spacing wrong by its own size, in squared spacings of misfit.
constexpr double spacing_weight = 0.02;

// As lay_lines takes them.
struct LineLayout {
  Vec2 spacing = {0.0, 0.0};  // mm; between neighbouring crossings along u and v
  Vec2 phase = {0.0, 0.0};    // spacings; of the warp and of the weft lines
};

// For each family the spacing and phase of least
//   sum_i w_i (distance of end i to its nearest line / spacing)^2 + spacing_weight (spacing / asked - 1)^2
// over the ends of the held parts of the outline; the lines pass exactly through the ends that bound a zone when any
// spacing in reach lets them. Never a greater sum than at the asked spacing and phase 0, which is what comes back
// without grips. Symmetric when the ends are. Deterministic.
[[nodiscard]] LineLayout fit_lines(const Outline& outline, const GripRegions& grips, const Vec2& asked);

}  // namespace weaveform::lattice
