// Moment laws of many pieces, as measured moment-curvature curves give them, for the inner loop of bending. The sum
// over pieces of GeneralLaw costs as much as it has pieces; here the piece is found by halving, in the same number of
// steps for every curvature, and its polynomial taken alone:
//   M(kappa) = M_p + sum_n c_pn t^(n+1) ,  t = kappa - from_p ,  from_p <= kappa < from_(p+1) .
// Included by files that are compiled once for each instruction set: nothing here but what is always inlined.
#pragma once

namespace weaveform {

// A constant stiffness, a law of a few pieces summed without branches (GeneralLaw), and one of many, looked up.
enum class MomentShape { constant, short_law, long_law };

struct LongLaw {
  static constexpr int most_pieces = 256;  // with that beyond a finite end
  static constexpr int most_terms = 6;     // of the moment's polynomial: a stiffness of degree 5
  double from[most_pieces];                // 1/mm; rising; beyond the last piece none begins: 1e30
  double moment[most_pieces];              // N mm; where each begins
  double coefficient[most_terms][most_pieces];

  // M at a curvature >= 0
  [[gnu::always_inline]] inline double stress(double curvature) const {
    int p = 0;
#pragma GCC unroll 8
    for (int half = most_pieces / 2; half > 0; half /= 2) p += curvature >= from[p + half] ? half : 0;
    const double t = curvature - from[p];
    double polynomial = coefficient[most_terms - 1][p];
#pragma GCC unroll 8
    for (int n = most_terms - 2; n >= 0; --n) polynomial = polynomial * t + coefficient[n][p];
    return moment[p] + polynomial * t;
  }
};

}  // namespace weaveform
