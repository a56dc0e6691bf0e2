#include "fabric/identify/shear_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/constrained_least_squares.hpp"
#include "fabric/identify/correlated_errors.hpp"
#include "fabric/identify/statistics.hpp"

namespace weaveform::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t least_grid = 10;         // angles; fewer leave nothing to judge a form by
constexpr std::size_t specimens_to_leave = 3;  // below, a left-out specimen says more of the scatter than of the form
constexpr double clearly_better = 2.0;         // of AICc (Burnham & Anderson 2002, section 2.6)

std::vector<ShearObservation> pooled(const std::vector<ShearSpecimen>& specimens, std::size_t without) {
  std::vector<ShearObservation> all;
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    if (k != without) all.insert(all.end(), specimens[k].grid.begin(), specimens[k].grid.end());
  }
  return all;
}

// Residuals at each angle of the grid, averaged over the specimens.
std::vector<double> mean_residuals(const std::vector<ShearSpecimen>& specimens, const ShearCurve& curve) {
  std::vector<double> residuals(specimens.front().grid.size(), 0.0);
  for (const auto& specimen : specimens) {
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const auto& seen = specimen.grid[i];
      residuals[i] += (seen.value - predicted(curve, seen)) / static_cast<double>(specimens.size());
    }
  }
  return residuals;
}

double error_on_left_out(const std::vector<ShearSpecimen>& specimens, const ShearForm& form) {
  double squares = 0.0, count = 0.0;
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    const ShearCurve curve = fit_shear_curve(pooled(specimens, k), form).curve;
    for (const auto& seen : specimens[k].grid) {
      const double error = seen.value - predicted(curve, seen);
      squares += error * error;
      count += 1.0;
    }
  }
  return std::sqrt(squares / count);
}

FormFit fit_form(const std::vector<ShearSpecimen>& specimens, const ShearForm& form) {
  FormFit fit;
  fit.form = form;
  fit.pooled = fit_shear_curve(pooled(specimens, specimens.size()), form);
  fit.misfit = root_mean_square(mean_residuals(specimens, fit.pooled.curve));
  for (const auto& specimen : specimens) fit.of_specimen.push_back(fit_shear_curve(specimen.grid, form).curve);
  if (specimens.size() >= specimens_to_leave) fit.left_out = error_on_left_out(specimens, form);
  return fit;
}

// AICc = m ln(RSS/m) + 2 k + 2 k (k + 1) / (m - k - 1), k counting the variance as well; m the number of values the
// mean curve's correlated residuals are worth.
double corrected_akaike(double misfit, double m, int parameters) {
  const double k = parameters + 1.0;
  return m * std::log(misfit * misfit + 1e-300) + 2.0 * k + 2.0 * k * (k + 1.0) / (m - k - 1.0);
}

void compare_forms(ShearFit& fit, FormAsked form) {
  FormFit& plain = fit.polynomial;
  const FormFit& richer = fit.with_start ? *fit.with_start : plain;
  const auto residuals = mean_residuals(fit.specimens, richer.pooled.curve);
  fit.correlation = neighbour_correlation(residuals, richer.form.parameters());
  const double least = richer.form.parameters() + 4.0;
  const double worth = std::max(least, effective_count(static_cast<double>(residuals.size()), fit.correlation));
  plain.aicc = corrected_akaike(plain.misfit, worth, plain.form.parameters());
  if (!fit.with_start) {
    fit.reason = "the form asked for";
    return;
  }
  FormFit& start = *fit.with_start;
  start.aicc = corrected_akaike(start.misfit, worth, start.form.parameters());
  const bool better = start.aicc < plain.aicc - clearly_better;
  const bool predicts = !start.left_out || *start.left_out <= *plain.left_out;
  fit.start_chosen = form == FormAsked::polynomial_start || (better && predicts);
  const std::string numbers = fmt::format("AICc {:.1f} with the start, {:.1f} without", start.aicc, plain.aicc);
  const std::string left_out =
      start.left_out
          ? fmt::format("; error on a specimen left out {:.3g} with, {:.3g} without", *start.left_out, *plain.left_out)
          : "";
  fit.reason = fmt::format("{}{} ({}{})", form == FormAsked::automatic ? "" : "the form asked for; ",
                           better && predicts ? "the friction-like start describes the tests better"
                                              : "the friction-like start does not describe the tests better",
                           numbers, left_out);
}

// Standard error of the law at each strain from the residuals of one specimen: delta method on the covariance of the
// parameters, J the observations' derivatives.
std::vector<double> errors_of_one(ShearFit& fit, const std::vector<double>& strains) {
  const FormFit& form = fit.chosen();
  const auto& grid = fit.specimens.front().grid;
  const auto row = [&](const auto& of) {
    const auto values = sensitivities(form.pooled.curve, form.form, of);
    return VectorXd(Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size())));
  };
  MatrixXd J(static_cast<Index>(grid.size()), static_cast<Index>(form.form.parameters()));
  VectorXd residual(J.rows());
  for (Index i = 0; i < J.rows(); ++i) {
    const auto& seen = grid[i];
    J.row(i) = row(seen).transpose();
    residual[i] = seen.value - predicted(form.pooled.curve, seen);
  }
  const CorrelatedErrors known = correlated_errors(J, residual);
  fit.freedom = known.freedom;
  std::vector<double> errors;
  for (const double strain : strains) {
    const VectorXd g = row(strain);
    errors.push_back(std::sqrt(std::max(0.0, g.dot(known.covariance * g))));
  }
  return errors;
}

// Standard error of the mean of the specimens' own curves.
std::vector<double> errors_between(ShearFit& fit, const std::vector<double>& strains) {
  const auto count = static_cast<double>(fit.specimens.size());
  fit.freedom = count - 1.0;
  std::vector<double> errors;
  for (const double strain : strains) {
    std::vector<double> stresses;
    for (const auto& curve : fit.chosen().of_specimen) stresses.push_back(stress_of(curve, strain));
    errors.push_back(deviation_of(stresses) / std::sqrt(count));
  }
  return errors;
}

// What the specimens' values are at a point of their grid, and what the law makes of them.
void add_values(const ShearFit& fit, std::size_t i, LawPoint& point) {
  std::vector<double> values, predictions;
  for (const auto& specimen : fit.specimens) {
    values.push_back(specimen.grid[i].value);
    predictions.push_back(predicted(fit.chosen().pooled.curve, specimen.grid[i]));
  }
  point.mean = mean_of(values);
  point.deviation = deviation_of(values);
  point.predicted = mean_of(predictions);
}

void tabulate_law(ShearFit& fit, double confidence, const std::vector<double>& angles) {
  std::vector<double> strains;
  strains.reserve(angles.size());
  for (const double angle : angles) strains.push_back(log_shear_strain(angle));
  const auto errors = fit.specimens.size() > 1 ? errors_between(fit, strains) : errors_of_one(fit, strains);
  const double shared = 1.0 - (1.0 - confidence) / fit.chosen().form.parameters();
  const double t = student_t(confidence, fit.freedom), t_whole = student_t(shared, fit.freedom);
  const ShearCurve& curve = fit.chosen().pooled.curve;
  for (std::size_t i = 0; i < angles.size(); ++i)
    fit.law.push_back({.angle = angles[i],
                       .strain = strains[i],
                       .stress = stress_of(curve, strains[i]),
                       .tangent = tangent_of(curve, strains[i]),
                       .half_band = t * errors[i],
                       .half_whole = t_whole * errors[i]});
}

void tabulate_on_grid(ShearFit& fit, double confidence) {
  std::vector<double> angles;
  for (const auto& seen : fit.specimens.front().grid) angles.push_back(seen.angle);
  tabulate_law(fit, confidence, angles);
  for (std::size_t i = 0; i < angles.size(); ++i) add_values(fit, i, fit.law[i]);
}

void warn_about(ShearFit& fit) {
  if (fit.specimens.size() == 1)
    fit.warnings.emplace_back(
        "one specimen only: the band holds for this specimen and says nothing of the scatter "
        "between specimens");
  const ShearCurveFit& chosen = fit.chosen().pooled;
  if (!chosen.constrained) return;
  const auto angle = [](double strain) { return std::asin(std::tanh(strain)) / degree; };
  std::string where = "its plateau was negative";
  if (!chosen.free_negative.empty())
    where = fmt::format("its tangent was negative from {:.1f} to {:.1f} deg", angle(chosen.free_negative.front()[0]),
                        angle(chosen.free_negative.back()[1]));
  fit.warnings.push_back(
      fmt::format("the free least-squares fit was rejected because {}; the constrained one raises the "
                  "sum of squared residuals by {:.2g} %",
                  where, 100.0 * (chosen.squares / chosen.free_squares - 1.0)));
}

}  // namespace

double local_value(const std::vector<double>& x, const std::vector<double>& y, double at, double half) {
  constexpr std::ptrdiff_t enough = 6;
  const double slack = 1e-9 * half;
  const auto from = std::lower_bound(x.begin(), x.end(), at - half - slack) - x.begin();
  const auto to = std::upper_bound(x.begin(), x.end(), at + half + slack) - x.begin();
  // The parabola must not be asked for values far from the points that carry it.
  if (to - from >= enough && x[from] <= at + slack && x[to - 1] >= at - slack && x[to - 1] - x[from] >= 0.5 * half) {
    const Eigen::Map<const VectorXd> xs(x.data() + from, to - from), ys(y.data() + from, to - from);
    MatrixXd A(to - from, 3);
    A.col(0).setOnes();
    A.col(1) = (xs.array() - at) / half;
    A.col(2) = A.col(1).array().square();
    return least_squares(A, ys)[0];
  }
  const auto above =
      std::clamp<std::ptrdiff_t>(std::lower_bound(x.begin(), x.end(), at) - x.begin(), 1, std::ssize(x) - 1);
  const double share = (at - x[above - 1]) / (x[above] - x[above - 1]);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

std::vector<double> common_grid(const std::vector<ShearSpecimen>& specimens,
                                const std::optional<std::array<double, 2>>& range, double step,
                                std::vector<std::string>& warnings) {
  double from = range ? (*range)[0] : 0.0, to = range ? (*range)[1] : std::numbers::pi / 2.0;
  std::vector<double> ends;
  for (const auto& specimen : specimens) {
    from = std::max(from, specimen.angle.front());
    to = std::min(to, specimen.angle.back());
    ends.push_back(specimen.angle.back());
  }
  for (const auto& specimen : specimens) {
    if (specimen.angle.back() < 0.7 * median_of(ends) && specimen.angle.back() <= to)
      warnings.push_back(
          fmt::format("{} ends at {:.1f} deg, the others at {:.1f} deg or so, and limits the law; leave "
                      "the specimen out for a wider one",
                      specimen.name, specimen.angle.back() / degree, median_of(ends) / degree));
  }
  // A curve that ends a rounding short of a multiple has still measured it.
  constexpr double rounding = 1e-6;  // steps
  std::vector<double> grid;
  for (int i = std::max(1, static_cast<int>(std::ceil(from / step - rounding))); i * step <= to + rounding * step; ++i)
    grid.push_back(i * step);
  if (grid.size() < least_grid)
    throw InputError(
        fmt::format("only {} angles of the common grid lie within all specimens, from {:.2f} to {:.2f} deg; "
                    "lower 'angle_step', widen the range of angles or leave a short specimen out",
                    grid.size(), from / degree, to / degree));
  return grid;
}

ShearFit fit_shear(std::vector<ShearSpecimen> specimens, int degree, FormAsked form, double confidence,
                   const std::vector<double>& law_angles) {
  ShearFit fit;
  fit.specimens = std::move(specimens);
  fit.polynomial = fit_form(fit.specimens, {degree, false});
  if (form != FormAsked::polynomial) fit.with_start = fit_form(fit.specimens, {degree, true});
  compare_forms(fit, form);
  for (const auto& specimen : fit.specimens)
    for (const auto& seen : specimen.grid) fit.end = std::max(fit.end, greatest_strain(seen));
  if (law_angles.empty())
    tabulate_on_grid(fit, confidence);
  else
    tabulate_law(fit, confidence, law_angles);
  warn_about(fit);
  return fit;
}

}  // namespace weaveform::identify
