// Shell cells (S4R, Hughes-Liu kind) on the lattice: every node has a director d, a unit vector of its own that starts
// as the fabric's normal. Along each yarn element of rest length L, unit vector t, from node a to b:
//   curvature         kappa = t.(d_b - d_a)/L          (phi^2 = u r(u), u = (t.(d_b - d_a))^2, as in yarn_bend.hpp)
//   transverse shear  gamma = t.(d_a + d_b)/2
//   E = yarns L W(kappa) + 1/2 G w L gamma^2 ,  w = yarns * interval the width that the element stands for
// (kappa > 0: directors spread, the side of the normal is bent outwards)
// and in every full cell, at its centre, the twist 2 kappa_12 = g1.d,2 + g2.d,1 , E = 1/2 D_66 A (2 kappa_12)^2.
//
// Shear sampled at the middles of the edges is that of Dvorkin & Bathe (1984, MITC4): no locking when thin. The mean of
// a cell's two opposite edges is what one point at its centre would see, half their difference is the hourglass mode,
// here borne by the material's own stiffness; its energy is reported (S4R bears it by a small artificial one).
#pragma once

#include <cmath>

#include "solver/bending/yarn_bend.hpp"

namespace weaveform {

struct ConstantMoment {
  double stiffness = 0.0;  // N mm^2 per yarn
  [[gnu::always_inline]] inline double secant(double /*square*/, double /*turn*/) const { return stiffness; }
};
struct CurvedMoment {
  GeneralLaw law;  // N mm per yarn against 1/mm
  [[gnu::always_inline]] inline double secant(double square, double /*turn*/) const { return law_secant(law, square); }
};
struct LongMoment {
  const LongLaw* law;  // N mm per yarn against 1/mm
  [[gnu::always_inline]] inline double secant(double square, double /*turn*/) const { return law_secant(*law, square); }
};
struct SidedMoment {
  const SidedLaw* law;  // N mm per yarn against 1/mm
  [[gnu::always_inline]] inline double secant(double square, double turn) const {
    return sided_secant(*law, square, turn > 0.0);
  }
};

// The gradients of one edge's energy: bend = dE/d(t.(d_b - d_a)), shear = dE/d(t.(d_a + d_b)) .
struct EdgeForces {
  double bend, shear;
};

// `turn` = t.(d_b - d_a), `sum` = t.(d_a + d_b); `shear_stiffness` = G w L (N mm).
template <class Moment>
[[gnu::always_inline]] inline EdgeForces shell_edge(const Moment& moment, double turn, double sum, double yarns,
                                                    double inverse_rest, double shear_stiffness) {
  const double u = turn * turn;
  const double r = 1.0 + u * (1.0 / 12 + u * (1.0 / 90 + u * (1.0 / 560)));
  const double slope = 1.0 / 12 + u * (2.0 / 90 + u * (3.0 / 560));
  const double secant = moment.secant(u * r * inverse_rest * inverse_rest, turn);
  return {yarns * inverse_rest * secant * (r + u * slope) * turn, 0.25 * shear_stiffness * sum};
}

}  // namespace weaveform
