// Polynomials in one variable: what the pieces of a tangent law are made of.
#pragma once

#include <array>
#include <vector>

namespace weaveform {

using Polynomial = std::vector<double>;  // p(x) = sum_n p[n] x^n; an empty one is zero
using Interval = std::array<double, 2>;  // least, greatest

[[nodiscard]] double value_of(const Polynomial& p, double x);
[[nodiscard]] Polynomial derivative_of(const Polynomial& p);
[[nodiscard]] Polynomial integral_of(const Polynomial& p);  // zero at x = 0
[[nodiscard]] Polynomial product_of(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial sum_of(const Polynomial& p, const Polynomial& q);

// Points in (from, to), from < to, where p changes sign, in rising order, each to the last bits. Ends may be infinite.
[[nodiscard]] std::vector<double> sign_changes(const Polynomial& p, double from, double to);

// Least and greatest value in [from, to]; infinite when the interval is and p grows without bound.
[[nodiscard]] Interval range_of(const Polynomial& p, double from, double to);

// Parts of [from, to] where p is below zero by more than its own rounding, in rising order.
[[nodiscard]] std::vector<Interval> negative_intervals(const Polynomial& p, double from, double to);

}  // namespace weaveform
