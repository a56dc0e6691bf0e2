// Moment laws of many pieces, as measured moment-curvature curves give them, for the inner loop of bending. The sum
// over pieces of GeneralLaw costs as much as it has pieces; here the piece is found by halving, in the same number of
// steps for every curvature, and its polynomial taken alone:
//   M(kappa) = M_p + sum_n c_pn t^(n+1) ,  t = kappa - from_p ,  from_p <= kappa < from_(p+1) .
// Included by files that are compiled once for each instruction set: nothing here but what is always inlined.
#pragma once

namespace weaveform {

// A constant stiffness, a law of a few pieces summed without branches (GeneralLaw), one of many, looked up, and one that
// is another in each sense of bending, looked up too.
enum class MomentShape { constant, short_law, long_law, sided_law };

// `sides`: laws that lie one after another in the same columns.
template <int sides>
struct LookedUpLaw {
  static constexpr int most_pieces = 256;  // of each, with that beyond a finite end
  static constexpr int most_terms = 6;     // of the moment's polynomial: a stiffness of degree 5
  double from[sides * most_pieces];        // 1/mm; rising; beyond the last piece none begins: 1e30
  double moment[sides * most_pieces];      // N mm; where each begins
  double coefficient[most_terms][sides * most_pieces];

  // M at a curvature >= 0, of the law whose pieces begin at `first`
  [[gnu::always_inline]] inline double stress(double curvature, int first = 0) const {
    int p = first;
#pragma GCC unroll 8
    for (int half = most_pieces / 2; half > 0; half /= 2) p += curvature >= from[p + half] ? half : 0;
    const double t = curvature - from[p];
    double polynomial = coefficient[most_terms - 1][p];
#pragma GCC unroll 8
    for (int n = most_terms - 2; n >= 0; --n) polynomial = polynomial * t + coefficient[n][p];
    return moment[p] + polynomial * t;
  }
};
using LongLaw = LookedUpLaw<1>;

// The half with the side of the mesh's normal outwards, then the other.
using SidedLaw = LookedUpLaw<2>;

}  // namespace weaveform
