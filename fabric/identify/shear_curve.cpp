#include "fabric/identify/shear_curve.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "fabric/identify/constrained_least_squares.hpp"

namespace weaveform::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr int tangent_checks = 200;     // strains at which the constrained fit keeps the tangent positive
constexpr double least_tangent = 1e-3;  // of the secant at the end: what "positive" means there
constexpr double greatest_rise = 0.2;   // 1; beyond, the start is no start but the whole curve
constexpr double smallest_rise = 1e-3;  // 1

// Columns of the unknowns (plateau,) c1, c2, ...: stress basis g/(g + rise), g, g^2, ...
RowVectorXd stress_row(const ShearForm& form, double rise, double g) {
  RowVectorXd row(form.degree + (form.start ? 1 : 0));
  Index column = 0;
  if (form.start) row[column++] = g / (g + rise);
  for (int n = 1; n <= form.degree; ++n) row[column++] = std::pow(g, n);
  return row;
}

RowVectorXd tangent_row(const ShearForm& form, double rise, double g) {
  RowVectorXd row(form.degree + (form.start ? 1 : 0));
  Index column = 0;
  if (form.start) row[column++] = rise / ((g + rise) * (g + rise));
  for (int n = 1; n <= form.degree; ++n) row[column++] = n * std::pow(g, n - 1);
  return row;
}

// Calls use(strain, weight) for every stress that counts in the observation.
template <class Use>
void for_each_stress(const ShearObservation& seen, Use use) {
  for (const StressWeight& at : seen.counted) use(at.strain, at.weight);
  if (!seen.counted.empty()) return;
  use(log_shear_strain(seen.angle), seen.full);
  if (seen.half != 0.0) use(log_shear_strain(0.5 * seen.angle), seen.half);
}

RowVectorXd observation_row(const ShearForm& form, double rise, const ShearObservation& seen) {
  RowVectorXd row = RowVectorXd::Zero(form.degree + (form.start ? 1 : 0));
  for_each_stress(seen, [&](double strain, double weight) { row += weight * stress_row(form, rise, strain); });
  return row;
}

ShearCurve curve_of(const ShearForm& form, double rise, const VectorXd& unknowns) {
  ShearCurve curve;
  Index column = 0;
  if (form.start) curve.start = {unknowns[column++], rise};
  curve.stress.assign(1, 0.0);
  for (int n = 1; n <= form.degree; ++n) curve.stress.push_back(unknowns[column++]);
  return curve;
}

struct Problem {
  MatrixXd A;
  VectorXd b;
  double end = 0.0;  // strain to which the tangent must be positive
};

Problem problem_of(const std::vector<ShearObservation>& observations, const ShearForm& form, double rise) {
  const auto rows = static_cast<Index>(observations.size());
  Problem problem{MatrixXd(rows, form.degree + (form.start ? 1 : 0)), VectorXd(rows), 0.0};
  for (Index i = 0; i < rows; ++i) {
    problem.A.row(i) = observation_row(form, rise, observations[i]);
    problem.b[i] = observations[i].value - observations[i].shift;
    problem.end = std::max(problem.end, greatest_strain(observations[i]));
  }
  return problem;
}

// Positive tangent on a grid of strains, by `margin` MPa, and a plateau that is not negative.
VectorXd constrained_solution(const Problem& problem, const ShearForm& form, double rise, double margin) {
  const Index extra = form.start ? 1 : 0;
  MatrixXd G(tangent_checks + 1 + extra, problem.A.cols());
  VectorXd h = VectorXd::Constant(G.rows(), margin);
  for (Index i = 0; i <= tangent_checks; ++i)
    G.row(i) = tangent_row(form, rise, problem.end * static_cast<double>(i) / tangent_checks);
  if (form.start) {
    G.bottomRows(1) = RowVectorXd::Unit(problem.A.cols(), 0);
    h[h.size() - 1] = 0.0;
  }
  return least_squares_above(problem.A, problem.b, G, h);
}

bool sound(const ShearCurve& curve, double end) {
  return curve.start.plateau >= 0.0 && negative_tangent(curve, end).empty();
}

ShearCurveFit fit_with_rise(const std::vector<ShearObservation>& observations, const ShearForm& form, double rise) {
  const Problem problem = problem_of(observations, form, rise);
  const auto squares = [&](const VectorXd& x) { return (problem.A * x - problem.b).squaredNorm(); };
  const VectorXd free = least_squares(problem.A, problem.b);
  ShearCurveFit fit;
  fit.curve = curve_of(form, rise, free);
  fit.squares = fit.free_squares = squares(free);
  if (sound(fit.curve, problem.end)) return fit;
  fit.constrained = true;
  fit.free_negative = negative_tangent(fit.curve, problem.end);
  // The grid may miss a dip between two strains; a margin ten times as large does not.
  double margin = least_tangent * std::abs(stress_of(fit.curve, problem.end)) / problem.end;
  for (int attempt = 0; attempt < 3; ++attempt, margin *= 10.0) {
    const VectorXd x = constrained_solution(problem, form, rise, margin);
    fit.curve = curve_of(form, rise, x);
    fit.curve.start.plateau = std::max(0.0, fit.curve.start.plateau);  // rounding of its constraint
    fit.squares = squares(x);
    if (sound(fit.curve, problem.end)) return fit;
  }
  throw InputError(
      "no law of this form has a positive tangent over the whole range; choose another 'form' or 'degree'");
}

// Golden-section search (Kiefer 1953) for the least of f in [a, b].
template <class F>
double golden_section(F f, double a, double b) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double c = b - ratio * (b - a), d = a + ratio * (b - a);
  double at_c = f(c), at_d = f(d);
  for (int i = 0; i < 40; ++i) {
    if (at_c < at_d) {
      b = d, d = c, at_d = at_c;
      at_c = f(c = b - ratio * (b - a));
    } else {
      a = c, c = d, at_c = at_d;
      at_d = f(d = a + ratio * (b - a));
    }
  }
  return 0.5 * (a + b);
}

double smallest_strain(const std::vector<ShearObservation>& observations) {
  double angle = HUGE_VAL;
  for (const auto& seen : observations) {
    if (seen.angle > 0.0) angle = std::min(angle, seen.angle);
  }
  return log_shear_strain(angle);
}

}  // namespace

double stress_of(const ShearCurve& curve, double strain) {
  const double start = curve.start.plateau > 0.0 ? curve.start.plateau * strain / (strain + curve.start.rise) : 0.0;
  return value_of(curve.stress, strain) + start;
}

double tangent_of(const ShearCurve& curve, double strain) {
  const double reach = strain + curve.start.rise;
  const double start = curve.start.plateau > 0.0 ? curve.start.plateau * curve.start.rise / (reach * reach) : 0.0;
  return value_of(derivative_of(curve.stress), strain) + start;
}

double predicted(const ShearCurve& curve, const ShearObservation& seen) {
  double value = seen.shift;
  for_each_stress(seen, [&](double strain, double weight) { value += weight * stress_of(curve, strain); });
  return value;
}

double greatest_strain(const ShearObservation& seen) {
  double greatest = 0.0;
  for_each_stress(seen, [&](double strain, double weight) {
    if (weight != 0.0) greatest = std::max(greatest, strain);
  });
  return greatest;
}

std::vector<Interval> negative_tangent(const ShearCurve& curve, double end) {
  Polynomial numerator = derivative_of(curve.stress);
  // Times (g + rise)^2 > 0 the tangent is a polynomial with its start as well.
  if (curve.start.plateau != 0.0) {
    const double rise = curve.start.rise;
    numerator = sum_of(product_of(numerator, {rise * rise, 2.0 * rise, 1.0}), {curve.start.plateau * rise});
  }
  return negative_intervals(numerator, 0.0, end);
}

ShearCurveFit fit_shear_curve(const std::vector<ShearObservation>& observations, const ShearForm& form) {
  if (static_cast<int>(observations.size()) <= form.parameters())
    throw InputError(
        "there are fewer points of shear than the law has coefficients; lower 'angle_step' or 'degree', or "
        "widen the range of angles");
  if (!form.start) return fit_with_rise(observations, form, 0.0);
  const double low = std::log(std::max(smallest_rise, 0.25 * smallest_strain(observations)));
  const double high = std::log(greatest_rise);
  const auto squares = [&](double log_rise) { return fit_with_rise(observations, form, std::exp(log_rise)).squares; };
  // The sum of squares may have several valleys: find the deepest on a coarse row of rises, then its bottom.
  constexpr int rises = 24;
  const double step = (high - low) / rises;
  int best = 0;
  double least = HUGE_VAL;
  for (int i = 0; i <= rises; ++i) {
    const double value = squares(low + i * step);
    if (value < least) least = value, best = i;
  }
  const double bottom =
      golden_section(squares, low + std::max(0, best - 1) * step, low + std::min(rises, best + 1) * step);
  return fit_with_rise(observations, form, std::exp(bottom));
}

std::vector<double> sensitivities(const ShearCurve& curve, const ShearForm& form, double g) {
  std::vector<double> all;
  if (form.start) {
    const double reach = g + curve.start.rise;
    all = {g / reach, -curve.start.plateau * g / (reach * reach)};
  }
  for (int n = 1; n <= form.degree; ++n) all.push_back(std::pow(g, n));
  return all;
}

std::vector<double> sensitivities(const ShearCurve& curve, const ShearForm& form, const ShearObservation& seen) {
  std::vector<double> sum(static_cast<std::size_t>(form.parameters()), 0.0);
  for_each_stress(seen, [&](double strain, double weight) {
    const auto of_stress = sensitivities(curve, form, strain);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * of_stress[i];
  });
  return sum;
}

}  // namespace weaveform::identify
