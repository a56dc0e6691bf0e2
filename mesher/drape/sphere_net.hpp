// The exact smooth net on a sphere whose generators are geodesics. A Chebyshev net's shear angle obeys
//   gamma_uv = K cos gamma ,   gamma = 0 on both generators            (Servant-Hazzidakis; K = 1/R^2 on a sphere)
// with u, v the yarn lengths from the seed along warp and weft. By similarity gamma = g(s), s = K u v:
//   s g'' + g' = cos g ,   g(0) = 0 ,   g = s - s^3/18 + ...  (odd)
#pragma once

namespace weaveform {

// rad; for s = u v / R^2 of either sign. Beyond the fold (below) the solution of the equation, which no fabric follows.
[[nodiscard]] double sphere_net_angle(double s);
// g'(s).
[[nodiscard]] double sphere_net_slope(double s);
// The s at which g reaches 90 deg: the net folds there.
[[nodiscard]] double sphere_net_end();

}  // namespace weaveform
