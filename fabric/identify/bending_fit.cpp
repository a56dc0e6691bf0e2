#include "fabric/identify/bending_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/card/card.hpp"
#include "fabric/identify/cantilever_profiles.hpp"
#include "fabric/identify/hanging_strip.hpp"
#include "fabric/identify/statistics.hpp"

namespace weaveform::identify {
namespace {

constexpr int even_places = 80, close_places = 60;  // of the law's table: evenly, and in equal ratios near zero
constexpr double first_place = 1e-3;                // of the greatest curvature
constexpr double falls_short = 0.7;                 // of the greatest curvature: a specimen that ends before is named
constexpr double senses_differ = 0.15;              // of the mean moment

// Rising curvatures, dense near zero, where the law is steepest.
std::vector<double> places_to(double reach) {
  std::vector<double> places;
  for (int i = 1; i <= even_places; ++i) places.push_back(reach * i / even_places);
  for (int i = 0; i < close_places; ++i)
    places.push_back(reach * std::pow(first_place, 1.0 - static_cast<double>(i) / close_places));
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end(), [&](double a, double b) { return b - a < 1e-6 * reach; }),
               places.end());
  return places;
}

// As far as two specimens say something, or the only one.
double common_reach(const std::vector<BendingSpecimen>& specimens, const std::optional<double>& asked) {
  std::vector<double> reaches;
  for (const auto& specimen : specimens) reaches.push_back(specimen.reach);
  std::sort(reaches.rbegin(), reaches.rend());
  const double common = reaches[std::min<std::size_t>(1, reaches.size() - 1)];
  return asked ? std::min(*asked, common) : common;
}

// Of the law at one curvature, what the specimens say that reach it: a mean that counts a specimen as much as its own
// error and the scatter between specimens let it (DerSimonian & Laird 1986), less towards the end of what it reaches, so
// that its end makes no step. The standard error is that of Hartung & Knapp (2001), not below what the weights say. Of
// tables, whose own errors are small beside the scatter and not asked for, that is the plain mean and s/sqrt(n).
struct Seen {
  BendingPoint point;
  double error = 0.0;  // N; standard error of the mean
};

Seen seen_at(const std::vector<BendingSpecimen>& specimens, double curvature) {
  constexpr double rounding = 1e-9, tapers = 0.25, least_weight = 0.02;
  std::vector<double> values, variance, taper;
  for (const auto& specimen : specimens) {
    if (specimen.reach * (1.0 + rounding) < curvature) continue;
    values.push_back(moment_at(specimen, curvature));
    variance.push_back(std::pow(error_at(specimen, curvature), 2));
    taper.push_back(std::clamp((specimen.reach - curvature) / (tapers * specimen.reach), least_weight, 1.0));
  }
  Seen seen;
  seen.point.curvature = curvature;
  seen.point.deviation = deviation_of(values);
  seen.point.specimens = static_cast<int>(values.size());
  const auto n = static_cast<double>(values.size());
  const bool own_errors = *std::min_element(variance.begin(), variance.end()) > 0.0;
  double between = 0.0;
  if (own_errors && values.size() > 1) {
    double sum = 0.0, squares = 0.0, mean = 0.0, q = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      sum += 1.0 / variance[k];
      squares += 1.0 / (variance[k] * variance[k]);
      mean += values[k] / variance[k];
    }
    mean /= sum;
    for (std::size_t k = 0; k < values.size(); ++k) q += std::pow(values[k] - mean, 2) / variance[k];
    between = std::max(0.0, (q - (n - 1.0)) / (sum - squares / sum));
  }
  double weights = 0.0, mean = 0.0, spread = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double weight = taper[k] / (own_errors ? variance[k] + between : 1.0);
    weights += weight;
    mean += weight * values[k];
  }
  mean /= weights;
  for (std::size_t k = 0; k < values.size(); ++k)
    spread += taper[k] / (own_errors ? variance[k] + between : 1.0) * std::pow(values[k] - mean, 2);
  seen.point.mean = mean;
  if (values.size() == 1) {
    seen.error = std::sqrt(variance[0]);
  } else {
    const double q = spread / (n - 1.0);
    seen.error = std::sqrt((own_errors ? std::max(1.0, q) : q) / weights);
  }
  return seen;
}

void add_bands(BendingFit& fit, const std::vector<double>& errors, double confidence) {
  for (std::size_t i = 0; i < fit.law.size(); ++i) {
    BendingPoint& at = fit.law[i];
    const double freedom = fit.specimens.size() == 1 ? fit.specimens.front().freedom : at.specimens - 1.0;
    const double left = at.moment - at.mean;
    fit.misfit = std::max(fit.misfit, std::abs(left));
    at.half_band = std::hypot(student_t(confidence, std::max(1.0, freedom)) * errors[i], left);
  }
  fit.freedom =
      fit.specimens.size() == 1 ? fit.specimens.front().freedom : static_cast<double>(fit.specimens.size()) - 1.0;
}

void mean_friction(BendingFit& fit) {
  std::vector<double> moments, rises;
  for (const auto& specimen : fit.specimens) {
    if (!specimen.friction) continue;
    moments.push_back(specimen.friction->moment);
    rises.push_back(specimen.friction->rise);
  }
  if (!moments.empty()) fit.friction = BendingFriction{mean_of(moments), mean_of(rises)};
}

void warn_about_bending(BendingFit& fit) {
  if (fit.specimens.size() == 1)
    fit.warnings.emplace_back(
        "one specimen only: the band holds for this specimen and says nothing of the scatter between specimens");
  const double reach = fit.law.back().curvature;
  for (const auto& specimen : fit.specimens)
    if (specimen.reach < falls_short * reach)
      fit.warnings.push_back(
          fmt::format("{} ends at a curvature of {:.3g} 1/mm; beyond, the law to {:.3g} 1/mm rests on "
                      "the others",
                      specimen.name, specimen.reach, reach));
  std::vector<double> face, back;
  for (const auto& specimen : fit.specimens) {
    const double moment = moment_at(specimen, 0.5 * std::min(reach, specimen.reach)) /
                          fit.curve.moment(0.5 * std::min(reach, specimen.reach));
    if (specimen.sense == BentSense::face) face.push_back(moment);
    if (specimen.sense == BentSense::back) back.push_back(moment);
  }
  if (face.empty() || back.empty()) return;
  const double difference = mean_of(face) - mean_of(back);
  if (std::abs(difference) > senses_differ)
    fit.warnings.push_back(
        fmt::format("bent with the face outwards the moment is {:.2f}, with the back outwards {:.2f} "
                    "times that of the law, which is one for both senses",
                    mean_of(face), mean_of(back)));
}

BendingFit fit_curves(BendingSource source, std::vector<BendingSpecimen> specimens, const FitSpec& spec) {
  BendingFit fit;
  fit.source = source;
  fit.specimens = std::move(specimens);
  const double reach = common_reach(fit.specimens, spec.bending_law.greatest_curvature);
  std::vector<double> errors;
  for (const double at : places_to(reach)) {
    const Seen seen = seen_at(fit.specimens, at);
    fit.law.push_back(seen.point);
    errors.push_back(seen.error);
  }
  mean_friction(fit);
  if (fit.friction && !spec.bending_law.friction)
    for (auto& at : fit.law) at.mean += fit.friction->moment * (1.0 - std::exp(-at.curvature / fit.friction->rise));
  std::vector<BendingReading> mean;
  for (const auto& at : fit.law) mean.push_back({at.curvature, at.mean, 0.0});
  fit.curve = fit_bending_curve(mean, {.pieces = spec.bending_law.pieces, .enough = 5e-4}).curve;
  for (auto& at : fit.law) {
    at.moment = fit.curve.moment(at.curvature);
    at.tangent = fit.curve.tangent_at(at.curvature);
  }
  add_bands(fit, errors, spec.confidence());
  warn_about_bending(fit);
  return fit;
}

// The bending length c = (B/w)^(1/3) of a strip whose tip lies `angle` (rad) below the clamp: of the heavy elastica, not
// of Peirce's formula for it, which is 2 % off at 41.5 deg.
double bending_length(double overhang, double angle) {
  const auto chord = [](double load) {
    const HangingTip tip = hanging_tip({{0.0, 1.0}, {1.0, 1.0}}, load, 1.0);
    return std::atan2(tip.drop, tip.x);
  };
  double low = 1e-2, high = 1e3;  // w L^3/B: chords of 0.1 and 86 deg
  for (int n = 0; n < 50; ++n) {
    const double middle = std::sqrt(low * high);
    (chord(middle) < angle ? low : high) = middle;
  }
  return overhang / std::cbrt(std::sqrt(low * high));
}

std::vector<double> rigidities_of(const TestSpec& test, const FitSpec& spec) {
  const double weight = test.weight ? *test.weight * 1e-6 : spec.area_weight();
  std::vector<double> rigidities = test.rigidities;
  for (const double length : test.bending_lengths) rigidities.push_back(weight * std::pow(length, 3));
  const double of_unit = test.overhangs.empty() ? 0.0 : bending_length(1.0, test.angle * degree);
  for (const double overhang : test.overhangs) rigidities.push_back(weight * std::pow(of_unit * overhang, 3));
  if (!test.trust_units)
    for (const double rigidity : rigidities)
      ask_about_stiffness(fmt::format("{}: [[peirce]] '{}'", spec.file, test.name), rigidity, weight,
                          "are the lengths in mm, rigidities in N mm and 'weight' in N/m^2");
  return rigidities;
}

BendingFit fit_numbers(const std::vector<const TestSpec*>& tests, const FitSpec& spec) {
  BendingFit fit;
  fit.source = BendingSource::peirce;
  for (const TestSpec* test : tests)
    for (const double rigidity : rigidities_of(*test, spec)) fit.rigidities.push_back(rigidity);
  fit.rigidity = mean_of(fit.rigidities);
  fit.rigidity_deviation = deviation_of(fit.rigidities);
  fit.rigidity_band = {fit.rigidity, fit.rigidity};
  const auto count = static_cast<double>(fit.rigidities.size());
  if (count > 1.0) {
    const double half = student_t(spec.confidence(), count - 1.0) * fit.rigidity_deviation / std::sqrt(count);
    fit.rigidity_band = {fit.rigidity - half, fit.rigidity + half};
    fit.freedom = count - 1.0;
  } else {
    fit.warnings.emplace_back("one number only: nothing is known of its scatter");
  }
  fit.warnings.emplace_back(
      "Peirce's number is one rigidity for all curvatures; fabrics that yield bend more than it says where they hang "
      "lower than his 41.5 deg, and less where they hang higher");
  return fit;
}

BendingFit fit_tests(BendingSource source, const std::vector<const TestSpec*>& tests, const FitSpec& spec) {
  if (source == BendingSource::peirce) return fit_numbers(tests, spec);
  std::vector<BendingSpecimen> specimens;
  for (const TestSpec* test : tests) {
    auto more = source == BendingSource::cantilever
                    ? cantilever_specimens(*test, spec)
                    : moment_curvature_specimens(*test, spec, tests.size() == 1 && test->files.size() == 1);
    std::move(more.begin(), more.end(), std::back_inserter(specimens));
  }
  return fit_curves(source, std::move(specimens), spec);
}

}  // namespace

std::string BendingFit::name() const {
  const std::string kind = name_of(source);
  if (along[0] && along[1]) return kind;
  return kind + "_" + yarn_families[along[0] ? 0 : 1];
}

std::vector<BendingFit> fit_bending(const FitSpec& spec) {
  std::vector<BendingFit> fits;
  for (const auto& [source, tests] : {std::pair(BendingSource::moment_curvature, &spec.moment_curvature),
                                      {BendingSource::cantilever, &spec.cantilever},
                                      {BendingSource::peirce, &spec.peirce}}) {
    std::array<std::vector<const TestSpec*>, 2> of_family;
    for (const auto& test : *tests)
      for (std::size_t f = 0; f < 2; ++f)
        if (bends_along(test, f)) of_family[f].push_back(&test);
    if (!of_family[0].empty() && of_family[0] == of_family[1]) {
      fits.push_back(fit_tests(source, of_family[0], spec));
      continue;
    }
    for (std::size_t f = 0; f < 2; ++f) {
      if (of_family[f].empty()) continue;
      fits.push_back(fit_tests(source, of_family[f], spec));
      fits.back().along = {f == 0, f == 1};
    }
  }
  return fits;
}

std::optional<std::size_t> bending_of(const std::vector<BendingFit>& fits, const FitSpec& spec, std::size_t family) {
  for (std::size_t k = 0; k < fits.size(); ++k) {
    const bool asked = spec.bending_law.from == BendingSource::automatic || spec.bending_law.from == fits[k].source;
    if (asked && fits[k].along[family]) return k;
  }
  return std::nullopt;
}

std::string bending_csv(const BendingFit& fit) {
  if (fit.is_constant()) {
    std::string text = "specimen,rigidity_N_mm\n";
    for (std::size_t k = 0; k < fit.rigidities.size(); ++k)
      text += fmt::format("{},{:.8g}\n", k + 1, fit.rigidities[k]);
    return text;
  }
  std::string text;
  for (std::size_t k = 0; k < fit.specimens.size(); ++k)
    text += fmt::format("# specimen_{}: {}\n", k + 1, fit.specimens[k].name);
  text += "curvature_1_per_mm,moment_N,tangent_N_mm,moment_low_N,moment_high_N,mean_N,deviation_N,specimens";
  for (std::size_t k = 0; k < fit.specimens.size(); ++k) text += fmt::format(",specimen_{}_N", k + 1);
  text += "\n";
  for (const auto& at : fit.law) {
    text += fmt::format("{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{:.8g},{}", at.curvature, at.moment, at.tangent,
                        at.moment - at.half_band, at.moment + at.half_band, at.mean, at.deviation, at.specimens);
    for (const auto& specimen : fit.specimens)
      text += specimen.reach * (1.0 + 1e-9) >= at.curvature ? fmt::format(",{:.8g}", moment_at(specimen, at.curvature))
                                                            : ",";
    text += "\n";
  }
  return text;
}

Chart bending_chart(const BendingFit& fit, double confidence) {
  Chart chart{.title = fmt::format("{}: moment and curvature", fit.name()),
              .x = {.title = "curvature (1/mm)", .from = 0.0},
              .y = {.title = "moment per width (N)", .from = 0.0}};
  ChartBand band{
      .label = fmt::format("{:.4g} % band", 100.0 * confidence), .x = {0.0}, .low = {0.0}, .high = {0.0}, .colour = 0};
  ChartSeries line{.label = "law", .x = {0.0}, .y = {0.0}, .mark = ChartMark::line, .colour = 0};
  for (const auto& at : fit.law) {
    line.x.push_back(at.curvature);
    line.y.push_back(at.moment);
    band.x.push_back(at.curvature);
    band.low.push_back(at.moment - at.half_band);
    band.high.push_back(at.moment + at.half_band);
  }
  chart.bands.push_back(std::move(band));
  for (std::size_t k = 0; k < fit.specimens.size(); ++k) {
    const BendingSpecimen& specimen = fit.specimens[k];
    ChartSeries series{.label = k == 0 ? "specimens" : "", .mark = ChartMark::points, .colour = 6};
    const bool readings = !specimen.curvature.empty();
    const auto& x = readings ? specimen.curvature : specimen.curve_curvature;
    const auto& y = readings ? specimen.moment : specimen.curve_moment;
    for (std::size_t i = 0; i < x.size(); ++i) {
      series.x.push_back(std::abs(x[i]));
      series.y.push_back(std::copysign(y[i], x[i] * y[i]));
    }
    chart.series.push_back(std::move(series));
  }
  chart.series.push_back(std::move(line));
  return chart;
}

}  // namespace weaveform::identify
