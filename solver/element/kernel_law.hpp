// Tangent laws packed for the inner loop: stress as a sum over pieces without branches. Since stress is the integral
// of the tangent, each piece adds the integral over the part of [0, e] that lies in it:
//   s(e) = sum_p S_p(clamp(e - anchor_p, low_p, high_p)),   S_p(0) = 0,
// with S_p the polynomial of piece p about its end nearest to zero strain.
#pragma once

#include "fabric/law/tangent_law.hpp"
#include "solver/element/lanes.hpp"

namespace weaveform {

template <int Pieces, int Degree>
struct KernelLaw {
  double anchor[Pieces] = {};
  double low[Pieces] = {};
  double high[Pieces] = {};
  double coefficient[Pieces][Degree] = {};  // of t, t^2, ..., t^Degree

  // always_inline: the loops over pieces must unroll inside the caller's vector loop
  template <class T>
  [[gnu::always_inline]] inline T stress(const T& strain) const {
    T sum = spread<T>(0.0);
#pragma GCC unroll 8
    for (int p = 0; p < Pieces; ++p) {
      const T t = at_most(at_least(strain - anchor[p], low[p]), high[p]);
      T polynomial = spread<T>(coefficient[p][Degree - 1]);
#pragma GCC unroll 8
      for (int n = Degree - 2; n >= 0; --n) polynomial = polynomial * t + coefficient[p][n];
      sum += polynomial * t;
    }
    return sum;
  }

  // C(e): the slope of the piece that e lies in.
  [[gnu::always_inline]] inline double tangent(double strain) const {
    double sum = 0.0;
#pragma GCC unroll 8
    for (int p = 0; p < Pieces; ++p) {
      const double t = strain - anchor[p];
      double slope = Degree * coefficient[p][Degree - 1];
#pragma GCC unroll 8
      for (int n = Degree - 2; n >= 0; --n) slope = slope * t + (n + 1) * coefficient[p][n];
      sum += t >= low[p] && t < high[p] ? slope : 0.0;
    }
    return sum;
  }
};

// The shape of the paper's laws (Tables 2 and 3): a cubic tangent from zero strain to a joint, from there on a constant
// one; with `pressed`, a constant one below zero strain, without, strains are never below. The general sum for it takes
// twice as long.
template <bool pressed>
struct JointLaw {
  double joint = 0.0;          // 1; of a law without a constant part beyond all strains
  double coefficient[4] = {};  // MPa; of e, e^2, e^3, e^4
  double taut = 0.0;           // MPa; the tangent beyond
  double slack = 0.0;          // MPa; that below zero strain

  template <class T>
  [[gnu::always_inline]] inline T stress(const T& strain) const {
    T t = at_most(strain, joint);
    T outer = spread<T>(taut);  // the tangent outside [0, joint]
    if constexpr (pressed) {
      t = at_least(t, 0.0);
      outer = select(strain < spread<T>(0.0), spread<T>(slack), outer);
    }
    return outer * (strain - t) +
           (((coefficient[3] * t + coefficient[2]) * t + coefficient[1]) * t + coefficient[0]) * t;
  }

  // C(e)
  [[gnu::always_inline]] inline double tangent(double strain) const {
    const double t = strain;
    const double cubic =
        ((4.0 * coefficient[3] * t + 3.0 * coefficient[2]) * t + 2.0 * coefficient[1]) * t + coefficient[0];
    const double stretched = strain < joint ? cubic : taut;
    return pressed && strain < 0.0 ? slack : stretched;
  }
};

// The shapes the inner loop is compiled for: the paper's and a general one.
using PaperLaw = JointLaw<true>;
using PaperShearLaw = JointLaw<false>;
using GeneralLaw = KernelLaw<8, 6>;

// Packs a law as it stands, on both sides of zero strain (yarn_law.hpp). Beyond its ends the tangent keeps its value,
// which takes a piece at each end that is finite. Returns false when the law has too many pieces or too high a degree
// for the shape.
[[nodiscard]] bool pack_law(const TangentLaw& law, GeneralLaw& packed);
template <bool pressed>
[[nodiscard]] bool pack_law(const TangentLaw& law, JointLaw<pressed>& packed);

}  // namespace weaveform
