#include "fabric/identify/tension_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "fabric/identify/constrained_least_squares.hpp"
#include "fabric/identify/statistics.hpp"

namespace weaveform::identify {
namespace {

constexpr std::size_t least_elastic_points = 5;
constexpr double stress_step = 0.05, first_stress = 0.05, last_stress = 0.90;  // of the greatest stress
constexpr double least_width = 0.25;   // of the greatest stress; narrower stretches are straight by chance
constexpr double straightness = 0.01;  // bow over rise
// Yarns of any fibre lie between a soft polymer's and a pitch carbon's modulus.
constexpr std::array<double, 2> plausible_modulus = {100.0, 1e6};  // MPa
constexpr double greatest_reach = 0.5;                             // 1; no reinforcement yarn reaches it

struct Range {
  std::size_t from = 0, to = 0;  // [from, to)
  [[nodiscard]] std::size_t size() const { return to - from; }
};

Eigen::VectorXd part_of(const std::vector<double>& values, const Range& range) {
  return Eigen::Map<const Eigen::VectorXd>(values.data() + range.from, static_cast<Eigen::Index>(range.size()));
}

// Bow of the best parabola over the stretch, against the rise of its best line: c (w/2)^2 / (b w) for strains of half
// width w/2 about their middle.
double bow(const std::vector<double>& strain, const std::vector<double>& stress, const Range& range) {
  const Eigen::VectorXd e = part_of(strain, range);
  const double middle = 0.5 * (e[0] + e[e.size() - 1]), half = 0.5 * (e[e.size() - 1] - e[0]);
  Eigen::MatrixXd A(e.size(), 3);
  A.col(0).setOnes();
  A.col(1) = (e.array() - middle) / half;
  A.col(2) = A.col(1).array().square();
  const Eigen::VectorXd c = least_squares(A, part_of(stress, range));
  return c[1] > 0.0 ? std::abs(c[2]) / (2.0 * c[1]) : HUGE_VAL;
}

// First row at which the stress reaches a level for good: noise may cross it before.
std::size_t reaches(const std::vector<double>& stress, double level) {
  std::size_t first = stress.size();
  while (first > 0 && stress[first - 1] >= level) --first;
  return first;
}

void fit_line(YarnSpecimen& yarn, const Range& range) {
  if (range.size() < least_elastic_points)
    throw InputError(
        fmt::format("{}: only {} points in the elastic part, strain {:.4g} to {:.4g}, at least {} are "
                    "needed; widen 'elastic_range' or record more",
                    yarn.name, range.size(), yarn.elastic[0], yarn.elastic[1], least_elastic_points));
  const Eigen::VectorXd e = part_of(yarn.strain, range), s = part_of(yarn.stress, range);
  const double middle = e.mean();
  Eigen::MatrixXd A(e.size(), 2);
  A.col(0).setOnes();
  A.col(1) = e.array() - middle;
  const Eigen::VectorXd line = least_squares(A, s);
  yarn.points = range.size();
  yarn.modulus = line[1];
  yarn.toe = middle - line[0] / line[1];
  const Eigen::VectorXd residual = s - A * line;
  const std::vector<double> residuals(residual.begin(), residual.end());
  yarn.scatter = root_mean_square(residuals);
  const double worth = effective_count(static_cast<double>(yarn.points), neighbour_correlation(residuals, 2));
  yarn.freedom = std::max(1.0, worth - 2.0);
  // Variance of a slope: that of the residuals, RSS/n * worth/freedom, over the spread of the strains, and n/worth
  // times as much because the points are worth fewer than they are.
  yarn.modulus_error = std::sqrt(residual.squaredNorm() / yarn.freedom / A.col(1).squaredNorm());
}

void check_plausible(const YarnSpecimen& yarn, const TestSpec& test) {
  if (test.trust_units) return;
  const bool machine = !test.displacement_column.empty();
  const double reach = yarn.strain.back();
  const auto fits_strain = [&](double ratio) { return reach * ratio < greatest_reach && reach * ratio > 1e-4; };
  if (!fits_strain(1.0)) {
    const Quantity quantity = machine ? Quantity::length : Quantity::strain;
    const std::string key = machine ? "displacement_unit" : "strain_unit";
    const std::string& unit = machine ? test.displacement_unit : test.strain_unit;
    throw InputError(
        fmt::format("{}: the strain at the greatest load is {:.3g}; is {} really '{}'{}{}? if it is right, "
                    "say trust_units = true",
                    yarn.name, reach, key, unit, fitting_units(quantity, unit, fits_strain),
                    machine ? ", and the gauge_length right" : ""));
  }
  const auto fits_modulus = [&](double ratio) {
    return yarn.modulus * ratio > plausible_modulus[0] && yarn.modulus * ratio < plausible_modulus[1];
  };
  if (!fits_modulus(1.0)) {
    const std::string key = machine ? "force_unit" : "stress_unit";
    const std::string& unit = machine ? test.force_unit : test.stress_unit;
    const Quantity quantity = machine ? Quantity::force : Quantity::stress;
    throw InputError(
        fmt::format("{}: the modulus comes out as {:.3g} MPa, which no yarn has; is {} really '{}'{}? if it "
                    "is right, say trust_units = true",
                    yarn.name, yarn.modulus, key, unit, fitting_units(quantity, unit, fits_modulus)));
  }
}

// Machine columns or derived ones to true strain and the law's stress.
YarnSpecimen stress_strain(const Curve& curve, const TestSpec& test, double section) {
  YarnSpecimen yarn;
  yarn.name = curve.specimen;
  yarn.notes = curve.notes;
  const bool machine = !test.displacement_column.empty();
  const bool engineering = machine || test.strain == StrainKind::engineering;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    const double stretch = curve.x[i] / (machine ? *test.gauge_length : 1.0);  // engineering strain, or true already
    const double strain = engineering ? std::log1p(stretch) : stretch;
    const double nominal = curve.y[i] / (machine ? section : 1.0);
    // Incompressible yarn: the section shrinks as the length grows, so s = F/A0 * L/L0.
    yarn.strain.push_back(strain);
    yarn.stress.push_back(test.stress == StressKind::true_stress ? nominal * std::exp(strain) : nominal);
  }
  return yarn;
}

YarnSpecimen fit_specimen(const Curve& curve, const TestSpec& test, double section) {
  YarnSpecimen yarn = stress_strain(curve, test, section);
  yarn.elastic = test.elastic_range ? *test.elastic_range : elastic_part(yarn.strain, yarn.stress, yarn.name);
  const auto begin = yarn.strain.begin();
  const Range range{static_cast<std::size_t>(std::lower_bound(begin, yarn.strain.end(), yarn.elastic[0]) - begin),
                    static_cast<std::size_t>(std::upper_bound(begin, yarn.strain.end(), yarn.elastic[1]) - begin)};
  fit_line(yarn, range);
  check_plausible(yarn, test);
  // A toe is reported once it is worth more than a few points of noise.
  if (std::abs(yarn.toe) > 0.02 * yarn.strain.back())
    yarn.notes.push_back(
        fmt::format("slack toe: the elastic line meets zero stress at a true strain of {:.3g}, which is "
                    "taken out",
                    yarn.toe));
  return yarn;
}

std::array<double, 2> modulus_band(const YarnFit& fit, double confidence) {
  const auto count = static_cast<double>(fit.specimens.size());
  const YarnSpecimen& first = fit.specimens.front();
  const double half = fit.specimens.size() > 1 ? student_t(confidence, count - 1.0) * fit.deviation / std::sqrt(count)
                                               : student_t(confidence, first.freedom) * first.modulus_error;
  return {fit.modulus - half, fit.modulus + half};
}

}  // namespace

std::array<double, 2> elastic_part(const std::vector<double>& strain, const std::vector<double>& stress,
                                   const std::string& specimen) {
  const double greatest = *std::max_element(stress.begin(), stress.end());
  const int first = static_cast<int>(std::lround(first_stress / stress_step));
  const int last = static_cast<int>(std::lround(last_stress / stress_step));
  const int least = static_cast<int>(std::lround(least_width / stress_step));
  for (int width = last - first; width >= least; --width) {
    std::optional<Range> straightest;
    double least_bow = straightness;
    for (int low = first; low + width <= last; ++low) {
      const Range range{reaches(stress, low * stress_step * greatest),
                        reaches(stress, (low + width) * stress_step * greatest)};
      if (range.size() < least_elastic_points || range.from >= range.to) continue;
      const double this_bow = bow(strain, stress, range);
      if (this_bow >= least_bow) continue;
      least_bow = this_bow;
      straightest = range;
    }
    if (straightest) return {strain[straightest->from], strain[straightest->to - 1]};
  }
  throw InputError(
      fmt::format("{}: no elastic part found: no stretch of the curve is straight to 1 % over a quarter of "
                  "the greatest stress; give 'elastic_range', or look at the curve",
                  specimen));
}

double YarnFit::greatest_stress() const {
  double greatest = 0.0;
  for (const auto& yarn : specimens)
    for (const double stress : yarn.stress) greatest = std::max(greatest, stress);
  return greatest;
}

YarnFit fit_yarn(const TestSpec& test, const std::filesystem::path& fit_file, double section, double confidence) {
  const bool machine = !test.displacement_column.empty();
  const Channel x = machine
                        ? displacement_channel(test)
                        : Channel{Quantity::strain, "strain", test.strain_column, test.strain_unit, test.strain_factor};
  const Channel y = machine
                        ? force_channel(test)
                        : Channel{Quantity::stress, "stress", test.stress_column, test.stress_unit, test.stress_factor};
  YarnFit fit;
  fit.test = test.name;
  fit.section = section;
  fit.true_stress = test.stress == StressKind::true_stress;
  fit.range_given = test.elastic_range.has_value();
  std::vector<double> moduli;
  for (const auto& curve : load_curves(test, fit_file, x, y)) {
    fit.specimens.push_back(fit_specimen(curve, test, section));
    moduli.push_back(fit.specimens.back().modulus);
  }
  fit.modulus = mean_of(moduli);
  fit.deviation = deviation_of(moduli);
  fit.band = modulus_band(fit, confidence);
  if (fit.specimens.size() == 1)
    fit.warnings.push_back(
        fmt::format("{}: one specimen only; its interval says nothing of the scatter between "
                    "specimens",
                    fit.test));
  const double middle = median_of(moduli);
  for (const auto& yarn : fit.specimens) {
    if (std::abs(yarn.modulus / middle - 1.0) > 0.2)
      fit.warnings.push_back(
          fmt::format("{}: {} has {:.0f} MPa, more than a fifth off the median {:.0f} MPa of its "
                      "test; look at that specimen",
                      fit.test, yarn.name, yarn.modulus, middle));
  }
  return fit;
}

}  // namespace weaveform::identify
