// Strips that hang over an edge under their own weight: the moment-curvature curve from the shape. With sigma the length
// along the strip from its free tip, theta the angle below the horizontal and w the weight per area, moments per width,
//   dM/dsigma = w sigma cos(theta) ,  dtheta/dsigma = -K(M) ,  dx/dsigma = -cos(theta) ,  dy/dsigma = sin(theta) ,
// with M(0) = 0: no shooting, for the tip's angle is one of the unknowns. K, the curvature of a moment, is the smoothing
// family: linear between equal steps of the moment and rising, its logarithmic slopes held together by a random walk.
// The least squares are over the points' distances from the curve, so that points need not be evenly spaced, and nothing
// is differentiated twice. At the clamp's edge the strip is level to a degree or so; how closely is left to the points, so
// that a strip whose clamp tilts is fitted as it hangs.
#pragma once

#include <array>
#include <vector>

#include "fabric/identify/bending_tests.hpp"

namespace weaveform::identify {

struct StripShape {
  std::vector<std::array<double, 2>> point;  // mm; x outwards, y up; from the clamp's side to the tip
  double clamp = 0.0;  // mm; along the strip from its tip to the clamp's edge; 0: unknown, and nothing held there
};

// Where the tip of a strip of `length` (mm) hangs that a level clamp holds: the heavy elastica, the tip's angle by
// bisection. `weight`: N/mm^2.
struct HangingTip {
  double x = 0.0, drop = 0.0;       // mm; of the tip from the clamp
  double greatest_curvature = 0.0;  // 1/mm; at the clamp
};
[[nodiscard]] HangingTip hanging_tip(const BendingCurve& law, double weight, double length);

// The specimen's curve and its errors. `weight`: N/mm^2. Throws InputError with the specimen's name when the shape is
// not one of a strip that hangs.
[[nodiscard]] BendingSpecimen fit_hanging_strip(const StripShape& shape, double weight, const std::string& name);

// So few of the points that noise does not make the way along them longer, and that way (mm).
[[nodiscard]] std::vector<std::array<double, 2>> thinned(const std::vector<std::array<double, 2>>& points);
[[nodiscard]] double polyline_length(const std::vector<std::array<double, 2>>& points);

}  // namespace weaveform::identify
