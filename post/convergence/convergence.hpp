// How far a result is from its limit as a mesh (or any other setting) is refined: observed order, Richardson's limit
// and the grid-convergence index.
//
// Levels of characteristic size h1 < h2 < h3 (1 the finest) with results f1, f2, f3. Asymptotically f = F + C h^p, so
//     (f3 − f2)/(f2 − f1) = (h3^p − h2^p)/(h2^p − h1^p)         observed order p (any ratios; Celik et al. 2008)
//     F = f1 + (f1 − f2)/((h2/h1)^p − 1)                        limit (Richardson 1911)
//     GCI = 1.25 |f1 − f2| / (|f1| ((h2/h1)^p − 1))             of three levels (Roache 1994; 1998)
// The index bounds the finest level's error by 1.25 |f1 − F|, which leaves F itself uncertain by 0.25 |f1 − F|.
// Where the three levels are not asymptotic (they oscillate, diverge, or p < 1/2) there is no limit to extrapolate to:
// f1 stands for it, uncertain by 3 |f2 − f1|/(sqrt(h2/h1) − 1), the index with the factor 3 and the least order 1/2 of
// Oberkampf & Roy (2010, section 8.6.3); when the levels oscillate, with max f − min f for the difference. An observed
// order above `greatest_order` is chance, and `greatest_order` is used instead, with the factor 3 too (same source).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace weaveform {

struct Level {
  double size = 0.0;    // h; of any unit, > 0
  double result = 0.0;  // f
};

enum class Trend { monotone, oscillating, diverging, slow, fast, unchanging };
[[nodiscard]] std::string trend_words(Trend trend);

struct Convergence {
  Trend trend = Trend::diverging;
  double order = 0.0;        // observed p; not a number when the levels oscillate or diverge or do not change
  double limit = 0.0;        // F, or f1 where there is no limit to extrapolate to
  double uncertainty = 0.0;  // of the limit, in the unit of f
  double index = 0.0;        // GCI: relative bound of the finest level's error, (|f1 − limit| + uncertainty)/|f1|
};

// What three levels say, given in any order. Throws InputError unless there are three different sizes > 0 and the
// results are finite.
[[nodiscard]] Convergence converge(std::vector<Level> three, double greatest_order = 2.0);

// All levels of a setting: what its three finest say, what each three neighbours say, and how well those agree. The
// index is trusted only where the limits of the finest three and the next three levels agree. Three levels alone cannot
// check themselves: the limit stays, but is as uncertain as if they were not asymptotic. Where four or more do not
// agree they are not asymptotic, and f1 stands for the limit. (Measured on the hemisphere example at coarsening 4, 2,
// 1: punch force 505.71, 513.78, 517.37 N, observed order 1.17, by the index a limit of 520.3 N within 0.7 N. At 1/2 it
// is 506.1 N.)
struct Refinement {
  std::vector<Level> level;   // finest first
  Convergence finest;         // of the three finest
  std::vector<double> order;  // observed by each three neighbours, finest first
  bool checked = false;       // there are four levels or more,
  bool agreed = false;        // and the limits of the finest three and the next three lie within their uncertainties,
                              // both being monotone: asymptotic as far as levels can tell
  double limit = 0.0;         // finest.limit, or f1 when checked and not agreed
  double uncertainty =
      0.0;  // of the limit: finest.uncertainty when agreed, else that of levels that are not asymptotic
  std::vector<double> error_bound;  // of each level: (|f − limit| + uncertainty)/scale, 0 for an exact result; a scale
                                    // of 0 means |limit|: give another where that may be near zero (an idle grip)
};
[[nodiscard]] Refinement refine(std::vector<Level> levels, double greatest_order = 2.0, double scale = 0.0);

// Index (finest first) of the coarsest level whose bound is within the tolerance, as are those of all finer levels;
// -1: none.
[[nodiscard]] int coarsest_within(const Refinement& refinement, double tolerance);

// Points (time, error) that no other beats in one without losing in the other, in the order of time; of equal points
// the first. Points that are not finite are left out.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<double>& time, const std::vector<double>& error);

}  // namespace weaveform
