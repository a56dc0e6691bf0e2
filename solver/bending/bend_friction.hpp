// Friction in the bending of one yarn at one crossing (Dahl 1968), beside its elastic law (yarn_bend.hpp). Out of the
// fabric's plane and in it the yarn's curvature is, with c = t+ - t-, n the fabric's normal, tau the unit mean of both
// tangents and b = n x tau,
//   kappa_out = (c.n) R/l ,  kappa_in = (c.b) R/l ,  R = sqrt(r(c.c))  (yarn_bend.hpp) ,
// both with a sign. Beside the law's moments act M phi_out and M phi_in (M the greatest, |phi| <= 1) with
//   dphi = (s - phi) |dkappa|/rise ,  s = sign(dkappa) ,  over a step  phi -> s + (phi - s) exp(-|dkappa|/rise) :
// so that a branch is the same however its steps are cut. Of the work M phi dkappa the part d(M rise phi^2/2) is stored,
// as of a spring that slides, and M phi^2 |dkappa| >= 0 is lost.
//
// Per yarn and length l: dE = M (phi_out dkappa_out + phi_in dkappa_in) l , with u = c.c and R' = dR/du
//   l dkappa_out = R (n.dc + c.dn) + 2 R' (c.n) c.dc
//   l dkappa_in  = R (b.dc + (tau x c).dn + (c x n).dtau) + 2 R' (c.b) c.dc .
#pragma once

#include <cmath>

#include "solver/bending/bend_geometry.hpp"

namespace weaveform {

// Of one family: the greatest moments of one yarn (N mm) out of plane and in it, and the rise (1/mm).
struct YarnFriction {
  double out = 0.0, in = 0.0, rise = 1.0;
};

// 1 - exp(-x), x >= 0, without branches: that of x/32 by Pade's (2, 2), 1e-13 of it up to x = 0.7, then squared five
// times; right to 1e-5 of itself at every x.
[[gnu::always_inline]] inline double one_less_exp(double x) {
  const double z = (x < 80.0 ? x : 80.0) * (1.0 / 32);
  double d = z / (1.0 + z * (0.5 + z * (1.0 / 12)));
#pragma GCC unroll 5
  for (int k = 0; k < 5; ++k) d = d * (2.0 - d);
  return d;
}

// phi after the curvature has changed by `change`.
[[gnu::always_inline]] inline double friction_after(double phi, double change, double inverse_rise) {
  const double size = change < 0.0 ? -change : change, s = change < 0.0 ? -1.0 : 1.0;
  return phi + (s - phi) * one_less_exp(size * inverse_rise);
}

// N, of a moment of 1 N mm: what is lost over that change, the work by the trapezium less what is stored.
[[gnu::always_inline]] inline double friction_loss(double before, double after, double change, double rise) {
  return 0.5 * (before + after) * change - 0.5 * rise * (after - before) * (after + before);
}

struct YarnTurn {
  double c[3], tau[3], b[3];
  double out, in;       // c.n, c.b
  double root, slope;   // R, R'
  double inverse_mean;  // 1/|t+ + t-|
};

[[gnu::always_inline]] inline YarnTurn yarn_turn(const double (&before)[3], const double (&after)[3],
                                                 const double (&n)[3]) {
  YarnTurn turn{};
  double u = 0.0, mean = 0.0;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    turn.c[k] = after[k] - before[k];
    turn.tau[k] = after[k] + before[k];
    u += turn.c[k] * turn.c[k];
    mean += turn.tau[k] * turn.tau[k];
  }
  turn.inverse_mean = 1.0 / std::sqrt(mean > 1e-12 ? mean : 1e-12);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) turn.tau[k] *= turn.inverse_mean;
  turn.b[0] = n[1] * turn.tau[2] - n[2] * turn.tau[1];
  turn.b[1] = n[2] * turn.tau[0] - n[0] * turn.tau[2];
  turn.b[2] = n[0] * turn.tau[1] - n[1] * turn.tau[0];
  turn.out = turn.c[0] * n[0] + turn.c[1] * n[1] + turn.c[2] * n[2];
  turn.in = turn.c[0] * turn.b[0] + turn.c[1] * turn.b[1] + turn.c[2] * turn.b[2];
  turn.root = std::sqrt(1.0 + u * (1.0 / 12 + u * (1.0 / 90 + u * (1.0 / 560))));
  turn.slope = 0.5 * (1.0 / 12 + u * (2.0 / 90 + u * (3.0 / 560))) / turn.root;
  return turn;
}

// Of moments M phi (N mm; times the yarns that bend): dE/dt+ = even + odd, dE/dt- = even - odd; dE/dn is added to h.
[[gnu::always_inline]] inline void friction_bend(const YarnTurn& turn, const double (&n)[3], double moment_out,
                                                 double moment_in, double (&odd)[3], double (&even)[3],
                                                 double (&h)[3]) {
  const double along = 2.0 * turn.slope * (moment_out * turn.out + moment_in * turn.in);
  const double of_out = moment_out * turn.root, of_in = moment_in * turn.root;
  const double(&c)[3] = turn.c;
  const double(&t)[3] = turn.tau;
  const double across[3] = {c[1] * n[2] - c[2] * n[1], c[2] * n[0] - c[0] * n[2], c[0] * n[1] - c[1] * n[0]};  // c x n
  const double turned[3] = {t[1] * c[2] - t[2] * c[1], t[2] * c[0] - t[0] * c[2],
                            t[0] * c[1] - t[1] * c[0]};  // tau x c
  const double part = across[0] * t[0] + across[1] * t[1] + across[2] * t[2];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    odd[k] = of_out * n[k] + of_in * turn.b[k] + along * c[k];
    even[k] = of_in * turn.inverse_mean * (across[k] - part * t[k]);
    h[k] += of_out * c[k] + of_in * turned[k];
  }
}

}  // namespace weaveform
