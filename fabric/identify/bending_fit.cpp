#include "fabric/identify/bending_fit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
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
constexpr double senses_differ = 0.15;              // of the mean moment: worth a warning, though within the bands

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

// Specimens that were bent with that side outwards, alone or among both.
std::vector<BendingSpecimen> bent_with(const std::vector<BendingSpecimen>& specimens, BentSense sense) {
  std::vector<BendingSpecimen> part;
  for (const auto& specimen : specimens)
    if (!specimen.half.empty())
      part.push_back(specimen.half[sense == BentSense::face ? 0 : 1]);
    else if (specimen.sense == sense || specimen.sense == BentSense::both)
      part.push_back(specimen);
  return part;
}

// Own errors count where a specimen is alone.
std::vector<BendingSpecimen> without_errors(std::vector<BendingSpecimen> specimens) {
  for (auto& specimen : specimens) {
    specimen.error_curvature.clear();
    specimen.error.clear();
  }
  return specimens;
}

// Means over the curvatures that both laws reach.
struct SensesCompared {
  double face = 0.0, back = 0.0;  // N; of the moments
  double difference = 0.0,
         band = 0.0;  // N; of |M_face - M_back| and of both half bands together, infinite where unknown
};

SensesCompared compared(const BendingFit& face, const BendingFit& back) {
  const auto half_band = [](const BendingFit& fit, double curvature) {
    const auto above = std::lower_bound(fit.law.begin(), fit.law.end() - 1, curvature,
                                        [](const BendingPoint& at, double x) { return at.curvature < x; });
    return above->half_band;
  };
  const auto has_band = [](const BendingFit& fit) {
    return fit.specimens.size() > 1 || !fit.specimens.front().error.empty();
  };
  const double reach = std::min(face.law.back().curvature, back.law.back().curvature);
  SensesCompared means;
  for (int i = 1; i <= even_places; ++i) {
    const double at = reach * i / even_places, m_face = face.curve.moment(at), m_back = back.curve.moment(at);
    means.face += m_face / even_places;
    means.back += m_back / even_places;
    means.difference += std::abs(m_face - m_back) / even_places;
    means.band += std::hypot(half_band(face, at), half_band(back, at)) / even_places;
  }
  if (!has_band(face) || !has_band(back)) means.band = std::numeric_limits<double>::infinity();
  return means;
}

// `ratio`: of the face's to the back's; the difference and both half bands together in `unit`, infinite where unknown.
std::string senses_sentence(const std::string& what, double ratio, double difference, double band, const char* unit) {
  return fmt::format(
      "Bent with the face outwards the {} is {:.3g} times that with the back outwards; they differ by {:.3g} {}, {}",
      what, ratio, difference, unit,
      std::isinf(band)    ? std::string("and the bands of so few readings are not known")
      : difference > band ? fmt::format("more than their bands' {:.3g} {}", band, unit)
                          : fmt::format("within their bands' {:.3g} {}", band, unit));
}

// Two fits as one for each sense.
std::vector<BendingFit> as_senses(BendingFit face, BendingFit back, const std::string& said) {
  face.sense = BentSense::face;
  back.sense = BentSense::back;
  face.senses = back.senses = said + ": each sense has its own law.";
  return {std::move(face), std::move(back)};
}

// One fit of all, and how the senses compared.
std::vector<BendingFit> as_one(BendingFit both, const std::string& said, bool worth_a_warning) {
  both.senses = said + ": one law for both.";
  if (worth_a_warning)
    both.warnings.push_back(said + ": the law is one for both; test more specimens to tell them apart");
  return {std::move(both)};
}

// One law of all specimens, or one for each sense.
std::vector<BendingFit> fit_senses(BendingSource source, const std::vector<BendingSpecimen>& specimens, bool own_errors,
                                   const FitSpec& spec) {
  const auto tells = [&](BentSense sense) {
    return std::any_of(specimens.begin(), specimens.end(), [&](const BendingSpecimen& specimen) {
      return !specimen.half.empty() || specimen.sense == sense;
    });
  };
  const auto fitted = [&](std::vector<BendingSpecimen> part) {
    const bool alone = own_errors || part.size() == 1;
    return fit_curves(source, alone ? std::move(part) : without_errors(std::move(part)), spec);
  };
  if (!tells(BentSense::face) || !tells(BentSense::back)) return {fitted(specimens)};
  BendingFit face = fitted(bent_with(specimens, BentSense::face));
  BendingFit back = fitted(bent_with(specimens, BentSense::back));
  const SensesCompared means = compared(face, back);
  const std::string said = senses_sentence(
      fmt::format("mean moment to {:.3g} 1/mm", std::min(face.law.back().curvature, back.law.back().curvature)),
      means.face / means.back, means.difference, means.band, "N");
  if (means.difference > means.band) return as_senses(std::move(face), std::move(back), said);
  return as_one(fitted(specimens), said, means.difference > senses_differ * 0.5 * (means.face + means.back));
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

// The same of Peirce's numbers; one alone has no band and tells nothing apart.
std::vector<BendingFit> fit_number_senses(const std::vector<const TestSpec*>& tests, const FitSpec& spec) {
  const auto bent_with_side = [&](BentSense sense, bool or_both) {
    std::vector<const TestSpec*> part;
    std::copy_if(tests.begin(), tests.end(), std::back_inserter(part), [&](const TestSpec* test) {
      return test->sense == sense || (or_both && test->sense == BentSense::both);
    });
    return part;
  };
  if (bent_with_side(BentSense::face, false).empty() || bent_with_side(BentSense::back, false).empty())
    return {fit_numbers(tests, spec)};
  BendingFit face = fit_numbers(bent_with_side(BentSense::face, true), spec);
  BendingFit back = fit_numbers(bent_with_side(BentSense::back, true), spec);
  const bool known = face.rigidities.size() > 1 && back.rigidities.size() > 1;
  const double difference = std::abs(face.rigidity - back.rigidity);
  const double band = known ? std::hypot(face.rigidity_band[1] - face.rigidity, back.rigidity_band[1] - back.rigidity)
                            : std::numeric_limits<double>::infinity();
  const std::string said = senses_sentence("rigidity", face.rigidity / back.rigidity, difference, band, "N mm");
  if (difference > band) return as_senses(std::move(face), std::move(back), said);
  return as_one(fit_numbers(tests, spec), said, difference > senses_differ * 0.5 * (face.rigidity + back.rigidity));
}

std::vector<BendingFit> fit_tests(BendingSource source, const std::vector<const TestSpec*>& tests,
                                  const FitSpec& spec) {
  if (source == BendingSource::peirce) return fit_number_senses(tests, spec);
  // tables have errors of their own where one is all there is, of both senses or of its own
  const auto alone = [&](const TestSpec& test) {
    const auto beside = [&](const TestSpec* other) {
      return other->sense == test.sense || other->sense == BentSense::both || test.sense == BentSense::both;
    };
    return test.files.size() == 1 && std::count_if(tests.begin(), tests.end(), beside) == 1;
  };
  std::vector<BendingSpecimen> specimens;
  for (const TestSpec* test : tests) {
    auto more = source == BendingSource::cantilever ? cantilever_specimens(*test, spec)
                                                    : moment_curvature_specimens(*test, spec, alone(*test));
    std::move(more.begin(), more.end(), std::back_inserter(specimens));
  }
  const bool one_file = tests.size() == 1 && tests.front()->files.size() == 1;
  return fit_senses(source, specimens, source == BendingSource::cantilever || one_file, spec);
}

}  // namespace

std::string BendingFit::name() const {
  std::string text = name_of(source);
  if (!along[0] || !along[1]) text += "_" + yarn_families[along[0] ? 0 : 1];
  return sense == BentSense::both ? text : text + "_" + name_of(sense);
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
    const auto add = [&fits, &spec, source = source](const auto& of_tests, const std::array<bool, 2>& along) {
      if (of_tests.empty()) return;
      for (auto& fit : fit_tests(source, of_tests, spec)) {
        fit.along = along;
        fits.push_back(std::move(fit));
      }
    };
    if (of_family[0] == of_family[1]) {
      add(of_family[0], {true, true});
      continue;
    }
    add(of_family[0], {true, false});
    add(of_family[1], {false, true});
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
