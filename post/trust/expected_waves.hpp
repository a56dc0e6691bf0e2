// The length that wrinkles would have, before a run: where a pushed ring holds a blank that bends, friction under it pulls
// the fabric that it lets go on, and that pull is what waves across it have for a foundation (Cerda & Mahadevan 2003):
//     l = 2 sqrt(pi) (D/T)^(1/4) sqrt(L) ,   T = (mu + mu') F/(2 pi R) ,   L = R
// F the ring's force, mu its friction, mu' the greatest of a tool at rest (the other face's), R the opening, D the least
// rigidity of the two directions at the curvature from which a bend counts as a wrinkle. It is the order of the length:
// docs/wrinkles.md says what drawn parts had instead. Whether it comes to wrinkles is another matter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/resolve/resolved.hpp"

namespace weaveform {

struct ExpectedWaves {
  double wavelength = 0.0;  // mm
  double cells = 0.0;       // a wave, of the longer element
  double rigidity = 0.0;    // N mm
  double tension = 0.0;     // N/mm
  double span = 0.0;        // mm
};

// Of one ply; none where nothing holds it so, or where it does not bend.
[[nodiscard]] std::optional<ExpectedWaves> expected_waves(const Resolved& ply);

// early_warnings, and a line for each ply whose mesh has no waves as short as those: fewer than pi cells (waves.hpp).
[[nodiscard]] std::vector<std::string> warnings_before(const Resolved& model);

}  // namespace weaveform
