#include "fabric/law/polynomial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weaveform {

double value_of(const Polynomial& p, double x) {
  double sum = 0.0;  // Horner
  for (auto c = p.rbegin(); c != p.rend(); ++c) sum = sum * x + *c;
  return sum;
}

Polynomial derivative_of(const Polynomial& p) {
  Polynomial d;
  for (std::size_t n = 1; n < p.size(); ++n) d.push_back(static_cast<double>(n) * p[n]);
  return d;
}

Polynomial integral_of(const Polynomial& p) {
  Polynomial s = {0.0};
  for (std::size_t n = 0; n < p.size(); ++n) s.push_back(p[n] / static_cast<double>(n + 1));
  return s;
}

Polynomial product_of(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial r(p.size() + q.size() - 1, 0.0);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  }
  return r;
}

Polynomial sum_of(const Polynomial& p, const Polynomial& q) {
  Polynomial r(std::max(p.size(), q.size()), 0.0);
  for (std::size_t n = 0; n < p.size(); ++n) r[n] += p[n];
  for (std::size_t n = 0; n < q.size(); ++n) r[n] += q[n];
  return r;
}

namespace {

Polynomial without_leading_zeros(Polynomial p) {
  while (!p.empty() && p.back() == 0.0) p.pop_back();
  return p;
}

// The interval, cut to where roots can lie: |root| <= 1 + max |c_n / c_last| (Cauchy 1829). p has no leading zeros.
Interval finite_part(const Polynomial& p, double from, double to) {
  double bound = 1.0;
  for (const double c : p) bound = std::max(bound, 1.0 + std::abs(c / p.back()));
  return {std::max(from, -bound), std::min(to, bound)};
}

// p(low) and p(high) differ in sign and p is monotonic between: halve until no number lies between.
double bisect(const Polynomial& p, double low, double high) {
  const bool rising = value_of(p, low) < 0.0;
  while (true) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    ((value_of(p, middle) < 0.0) == rising ? low : high) = middle;
  }
}

// p(x) for x -> to (or from), also at infinity.
double end_value(const Polynomial& p, double x) {
  if (std::isfinite(x)) return value_of(p, x);
  if (p.size() <= 1) return p.empty() ? 0.0 : p[0];
  const bool odd = p.size() % 2 == 0;  // the degree is size - 1
  return (x < 0.0 && odd ? -p.back() : p.back()) * std::numeric_limits<double>::infinity();
}

// Size of the terms that make up p(x): the measure of its rounding error.
double magnitude_at(const Polynomial& p, double x) {
  double sum = 0.0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) sum = sum * std::abs(x) + std::abs(*c);
  return sum;
}

}  // namespace

std::vector<double> sign_changes(const Polynomial& given, double from, double to) {
  const Polynomial p = without_leading_zeros(given);
  if (p.size() <= 1) return {};
  const auto [low, high] = finite_part(p, from, to);
  if (!(low < high)) return {};
  // Between two turning points p is monotonic, so it crosses zero there once or not at all.
  std::vector<double> knots = sign_changes(derivative_of(p), low, high);
  knots.insert(knots.begin(), low);
  knots.push_back(high);
  std::vector<double> roots;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const bool below = value_of(p, knots[i]) < 0.0;
    if (below == (value_of(p, knots[i + 1]) < 0.0)) continue;
    const double root = bisect(p, knots[i], knots[i + 1]);
    if (root > from && root < to) roots.push_back(root);
  }
  return roots;
}

Interval range_of(const Polynomial& given, double from, double to) {
  const Polynomial p = without_leading_zeros(given);
  const double first = end_value(p, from), last = end_value(p, to);
  Interval range = {std::min(first, last), std::max(first, last)};
  if (!(from < to)) return range;
  for (const double x : sign_changes(derivative_of(p), from, to)) {
    range = {std::min(range[0], value_of(p, x)), std::max(range[1], value_of(p, x))};
  }
  return range;
}

std::vector<Interval> negative_intervals(const Polynomial& given, double from, double to) {
  const Polynomial p = without_leading_zeros(given);
  std::vector<double> knots = sign_changes(p, from, to);
  knots.insert(knots.begin(), from);
  knots.push_back(to);
  std::vector<Interval> parts;
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double least = range_of(p, knots[i], knots[i + 1])[0];
    const double size = magnitude_at(p, std::isfinite(knots[i + 1]) ? knots[i + 1] : knots[i]);
    if (least < -1e-13 * size) parts.push_back({knots[i], knots[i + 1]});
  }
  return parts;
}

}  // namespace weaveform
