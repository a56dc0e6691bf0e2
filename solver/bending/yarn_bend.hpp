// Bending of one yarn at one crossing (a rotation-free B31). With unit tangents t- and t+ of the elements before and
// after, c = t+ - t- is perpendicular to their mean and |c| = 2 sin(phi/2), phi the turn. The curvature over the spread
// l (bends.hpp) and its parts out of the fabric's plane and in it, n the fabric's normal:
//   kappa^2 = phi^2/l^2 = u r(u)/l^2 ,  u = c.c ,  r = 1 + u/12 + u^2/90 + u^3/560   (phi^2 = 4 asin^2(sqrt(u)/2); at
//   kappa_out^2 = (c.n)^2 r/l^2 ,  kappa_in^2 = (u - (c.n)^2) r/l^2                    90 deg 0.7 % off, never falling)
// Energy l (W_in(kappa_in) + W_out(kappa_out)), W the integral of the moment law, so that with the secants S = M/kappa
//   dE = l (S_in d(kappa_in^2)/2 + S_out d(kappa_out^2)/2) .
// A law of two senses has S_out of the half that holds: where c.n < 0 the side of the normal is bent outwards (its `face`
// half), where c.n > 0 the other. S jumps where the halves meet, at kappa_out = 0; the force is S kappa and does not.
// Pure bending closes a chain of N chords into a circle at M = B 2 pi/L, to 1 % for N = 4 and 1e-4 for N = 10.
#pragma once

#include <cmath>

#include "solver/bending/long_law.hpp"
#include "solver/element/kernel_law.hpp"

namespace weaveform {

// Constant flexural stiffness (N mm^2), in plane and out of plane. `turn`: c.n, of whose sign odd laws know nothing.
struct ConstantFlexure {
  double in = 0.0, out = 0.0;
  [[gnu::always_inline]] inline double secant_in(double /*square*/) const { return in; }
  [[gnu::always_inline]] inline double secant_out(double /*square*/, double /*turn*/) const { return out; }
};

// Moment-curvature laws, of few pieces, of many and of two senses; a curvature below 1e-9/mm is as good as none.
template <class Law>
[[gnu::always_inline]] inline double law_secant(const Law& law, double square) {
  const double curvature = std::sqrt(square) + 1e-9;
  return law.stress(curvature) / curvature;
}
[[gnu::always_inline]] inline double sided_secant(const SidedLaw& law, double square, bool outwards) {
  const double curvature = std::sqrt(square) + 1e-9;
  return law.stress(curvature, outwards ? 0 : SidedLaw::most_pieces) / curvature;
}
struct CurvedFlexure {
  GeneralLaw in, out;
  [[gnu::always_inline]] inline double secant_in(double square) const { return law_secant(in, square); }
  [[gnu::always_inline]] inline double secant_out(double square, double /*turn*/) const {
    return law_secant(out, square);
  }
};
struct LongFlexure {
  const LongLaw *in, *out;
  [[gnu::always_inline]] inline double secant_in(double square) const { return law_secant(*in, square); }
  [[gnu::always_inline]] inline double secant_out(double square, double /*turn*/) const {
    return law_secant(*out, square);
  }
};
struct SidedFlexure {
  const LongLaw* in;
  const SidedLaw* out;
  [[gnu::always_inline]] inline double secant_in(double square) const { return law_secant(*in, square); }
  [[gnu::always_inline]] inline double secant_out(double square, double turn) const {
    return sided_secant(*out, square, turn < 0.0);
  }
};

// dE/dt+ = g = -dE/dt-, and what the normal feels, dE/dn, added to h. `yarns` bend over `spread` = 1/inverse_spread.
// With `isotropic` both laws are the same and n is not read.
template <bool isotropic, class Flexure>
[[gnu::always_inline]] inline void yarn_bend(const Flexure& flexure, const double (&before)[3],
                                             const double (&after)[3], const double (&n)[3], double yarns,
                                             double inverse_spread, double (&g)[3], double (&h)[3]) {
  const double c[3] = {after[0] - before[0], after[1] - before[1], after[2] - before[2]};
  const double u = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
  const double r = 1.0 + u * (1.0 / 12 + u * (1.0 / 90 + u * (1.0 / 560)));
  const double slope = 1.0 / 12 + u * (2.0 / 90 + u * (3.0 / 560));  // dr/du
  const double scale = yarns * inverse_spread, square = inverse_spread * inverse_spread;
  if constexpr (isotropic) {
    const double factor = scale * flexure.secant_out(u * r * square, 0.0) * (r + u * slope);
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) g[k] = factor * c[k];
  } else {
    const double a = c[0] * n[0] + c[1] * n[1] + c[2] * n[2];
    const double out = a * a, in = u > out ? u - out : 0.0;
    const double s_in = flexure.secant_in(in * r * square), s_out = flexure.secant_out(out * r * square, a);
    const double of_c = scale * (slope * (s_in * in + s_out * out) + r * s_in);
    const double of_n = scale * r * (s_out - s_in) * a;
#pragma GCC unroll 3
    for (int k = 0; k < 3; ++k) {
      g[k] = of_c * c[k] + of_n * n[k];
      h[k] += of_n * c[k];
    }
  }
}

// Force on the node at the far end of an element with unit tangent t: dt = (I - t t) dx / length.
[[gnu::always_inline]] inline void bend_force(const double (&g)[3], const double (&t)[3], double inverse_length,
                                              double (&force)[3]) {
  const double along = g[0] * t[0] + g[1] * t[1] + g[2] * t[2];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) force[k] = -inverse_length * (g[k] - along * t[k]);
}

}  // namespace weaveform
