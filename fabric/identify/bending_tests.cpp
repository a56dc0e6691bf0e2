#include "fabric/identify/bending_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/error.hpp"
#include "fabric/identify/correlated_errors.hpp"
#include "fabric/identify/curve.hpp"

namespace weaveform::identify {
namespace {

using Eigen::Index;

// 1/mm; a strip bent to a radius of 5 m is flat, one of 1.4 mm folded
constexpr std::array<double, 2> plausible_curvature = {2e-4, 0.7};
constexpr std::array<double, 2> plausible_bending_length = {
    8.0, 1200.0};                    // mm; bending lengths, of a veil and of a laminate
constexpr double turn_share = 0.05;  // of the range of curvatures: more than noise, a turn of the machine
constexpr double both_senses = 0.1;  // of the greatest curvature: a record that goes there the other way, goes both
constexpr std::size_t rows_of_branch = 4;  // fewer on average: the rows are in no order
constexpr double toe_stiffness = 0.5;      // of the steepest: a curve that starts softer than that has a toe
constexpr double above_toe = 0.7;          // of the greatest moment: a steep place so high is a kink or noise
constexpr double least_toe = 0.02, usual_toe = 0.08, longest_toe = 0.4;  // of the greatest curvature
constexpr double friction_seen = 0.01;                                   // of the greatest moment
constexpr int error_places = 40;

double greatest_size(const std::vector<double>& values) {
  double greatest = 0.0;
  for (const double value : values) greatest = std::max(greatest, std::abs(value));
  return greatest;
}

// Where the record turns: first row, every turn, last row. Steps back of less than `least` are noise.
std::vector<std::size_t> turns_of(const std::vector<double>& x, double least) {
  std::vector<std::size_t> turns = {0};
  std::size_t high = 0, low = 0;
  int way = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (x[i] > x[high]) high = i;
    if (x[i] < x[low]) low = i;
    if (way <= 0 && x[i] - x[low] > least) {
      if (way < 0) turns.push_back(low);
      way = 1;
      high = i;
    } else if (way >= 0 && x[high] - x[i] > least) {
      if (way > 0) turns.push_back(high);
      way = -1;
      low = i;
    }
  }
  turns.push_back(x.size() - 1);
  return turns;
}

// The record's rows of one sense, counted positive, through the checks that every test's curve passes.
std::vector<BendingReading> one_sense(const Curve& raw, double sign, const Channel& x, const Channel& y,
                                      std::vector<std::string>& notes) {
  Curve part{raw.specimen, {}, {}, {}};
  for (std::size_t i = 0; i < raw.x.size(); ++i) {
    if (sign * raw.x[i] < 0.0) continue;
    part.x.push_back(sign * raw.x[i]);
    part.y.push_back(sign * raw.y[i]);
  }
  part = prepared_curve(std::move(part), x, y);
  notes.insert(notes.end(), part.notes.begin(), part.notes.end());
  std::vector<BendingReading> readings;
  for (std::size_t i = 0; i < part.x.size(); ++i) readings.push_back({sign * part.x[i], sign * part.y[i], 0.0});
  return readings;
}

// Clamps that let the strip turn before they hold it: the curve starts soft and stiffens. The tangent where it is
// steepest meets zero moment at the toe's end; curvatures are counted from there, and what was below is left out.
bool take_out_toe(const BendingCurve& curve, double reach, double sign, std::vector<BendingReading>& readings,
                  BendingSpecimen& specimen) {
  const auto steepest =
      static_cast<std::size_t>(std::max_element(curve.tangent.begin(), curve.tangent.end()) - curve.tangent.begin());
  const double at = curve.knot[steepest], stiffness = curve.tangent[steepest];
  if (!(curve.tangent.front() < toe_stiffness * stiffness)) return false;
  if (curve.moment(at) > above_toe * curve.moment(reach)) return false;
  const double toe = at - curve.moment(at) / stiffness;
  if (!(toe > least_toe * reach)) return false;
  if (toe > longest_toe * reach)
    throw InputError(
        fmt::format("{}: the moment stays near zero to a curvature of {:.3g} 1/mm, {:.0f} % of the "
                    "greatest, before it rises; the clamps did not hold the strip, or the columns are "
                    "exchanged: cut the record or leave the specimen out",
                    specimen.name, toe, 100.0 * toe / reach));
  specimen.notes.push_back(
      fmt::format("the curve starts with a toe of {:.4g} 1/mm ({:.1f} % of the greatest curvature), "
                  "as of clamps that do not hold at once; taken out{}",
                  toe, 100.0 * toe / reach, toe > usual_toe * reach ? ": more than usual, look at the clamps" : ""));
  std::vector<BendingReading> kept;
  for (BendingReading reading : readings) {
    const double x = sign * reading.curvature;
    if (x >= 0.0 && x < at) continue;
    if (x >= at) reading.curvature -= sign * toe;
    kept.push_back(reading);
  }
  readings = std::move(kept);
  return true;
}

// Both senses by themselves, for toes and for the comparison of one with the other.
std::vector<BendingReading> of_sense(const std::vector<BendingReading>& readings, double sign) {
  std::vector<BendingReading> part;
  std::copy_if(readings.begin(), readings.end(), std::back_inserter(part),
               [&](const BendingReading& reading) { return sign * reading.curvature > 0.0; });
  return part;
}

double reach_of(const std::vector<BendingReading>& readings) {
  double reach = 0.0;
  for (const auto& reading : readings) reach = std::max(reach, std::abs(reading.curvature));
  return reach;
}

constexpr std::size_t least_readings = 8;

// What kind of record a table holds.
struct Record {
  Curve rows;
  std::vector<BendingReading> readings = {};  // of one that does not go to and fro
  double reach = 0.0;                         // 1/mm
  bool two_senses = false, loop = false;
};

BendingCurveFit fit_once(const Record& record, bool two_sided, int pieces, BendingSpecimen& specimen) {
  std::vector<BendingReading> readings = record.readings;
  for (const double sign : {1.0, -1.0}) {
    const auto part = of_sense(readings, sign);
    if (part.size() < least_readings) continue;
    const BendingCurveFit alone = fit_bending_curve(part, {.pieces = std::min(pieces, 8), .stiff_start = false});
    (void)take_out_toe(alone.curve, reach_of(part), sign, readings, specimen);
    if (readings.size() < least_readings)
      throw InputError(
          fmt::format("{}: without its toe only {} points are left; record more", specimen.name, readings.size()));
  }
  specimen.reach = reach_of(readings);
  return fit_bending_curve(readings, {.pieces = pieces, .offset = record.two_senses, .two_sided = two_sided});
}

// A loop: friction by Dahl's model beside the curve; its rise by search.
BendingCurveFit fit_loop(const Record& record, bool two_sided, int pieces, BendingSpecimen& specimen) {
  const Curve& raw = record.rows;
  const double reach = record.reach;
  specimen.reach = reach;
  // a record that begins bent comes from the other side, or nobody knows from where: the state of a steady cycle
  const double start = std::abs(raw.x.front()) < both_senses * reach ? 0.0 : raw.x[1] > raw.x[0] ? -1.0 : 1.0;
  const auto readings = [&](double rise) {
    std::vector<BendingReading> all;
    const auto share = friction_share(raw.x, rise, start);
    for (std::size_t i = 0; i < raw.x.size(); ++i) all.push_back({raw.x[i], raw.y[i], share[i]});
    return all;
  };
  const auto fitted = [&](double rise, int most) {
    return fit_bending_curve(readings(rise),
                             {.pieces = most, .friction = true, .offset = record.two_senses, .two_sided = two_sided});
  };
  constexpr double least = 0.005, greatest = 0.6;  // of the reach
  constexpr int coarse = 12, refined = 16;
  double low = std::log(least * reach), high = std::log(greatest * reach);
  double best = low, best_misfit = std::numeric_limits<double>::infinity();
  for (int k = 0; k <= coarse; ++k) {
    const double at = low + (high - low) * k / coarse, misfit = fitted(std::exp(at), 4).misfit;
    if (misfit < best_misfit) best_misfit = misfit, best = at;
  }
  const double step = (high - low) / coarse;
  low = best - step, high = best + step;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int k = 0; k < refined; ++k) {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (fitted(std::exp(left), 6).misfit < fitted(std::exp(right), 6).misfit)
      high = right;
    else
      low = left;
  }
  const double rise = std::exp(0.5 * (low + high));
  BendingCurveFit fit = fitted(rise, pieces);
  if (fit.friction > friction_seen * greatest_size(raw.y)) specimen.friction = BendingFriction{fit.friction, rise};
  return fit;
}

void check_signs(const Curve& raw) {
  double product = 0.0;
  for (std::size_t i = 0; i < raw.x.size(); ++i) product += raw.x[i] * raw.y[i];
  if (product > 0.0) return;
  throw InputError(
      fmt::format("{}: the moment is against the curvature; does the machine count one of them the other "
                  "way? then say moment_factor = -1",
                  raw.specimen));
}

void ask_about_curvature(const Curve& raw, const TestSpec& test, double reach) {
  const auto plausible = [&](double ratio) {
    return ratio * reach > plausible_curvature[0] && ratio * reach < plausible_curvature[1];
  };
  if (plausible(1.0)) return;
  throw InputError(
      fmt::format("{}: the curvature goes to {:.4g} 1/mm, a radius of {:.3g} mm; is curvature_unit really "
                  "'{}'{}? if it is right, say trust_units = true",
                  raw.specimen, reach, 1.0 / reach, test.curvature_unit,
                  fitting_units(Quantity::curvature, test.curvature_unit, plausible)));
}

// Compares the record's two senses, half way.
void note_senses(const std::vector<BendingReading>& readings, BendingSpecimen& specimen) {
  const auto up = of_sense(readings, 1.0), down = of_sense(readings, -1.0);
  if (up.size() < least_readings || down.size() < least_readings) return;
  const double at = 0.5 * std::min(reach_of(up), reach_of(down));
  const double m_up = fit_bending_curve(up, {.pieces = 6}).curve.moment(at),
               m_down = fit_bending_curve(down, {.pieces = 6}).curve.moment(at);
  specimen.notes.push_back(
      fmt::format("bent both ways: at {:.4g} 1/mm the moment is {:.4g} N one way and {:.4g} N the "
                  "other; {}",
                  at, m_up, m_down,
                  specimen.sense == BentSense::both
                      ? "the curve is their mean; sense = \"face\" or \"back\", the side outwards at positive "
                        "curvatures, tells them apart"
                      : "positive curvatures are those with the " + name_of(specimen.sense) + " outwards"));
}

// Its curve in steps so fine that lines between them are as good: twelve from knot to knot.
void take_curve(const BendingCurve& curve, BendingSpecimen& specimen) {
  constexpr int parts = 12;
  specimen.first_stiffness = curve.tangent.front();
  specimen.curve_curvature = {0.0};
  for (std::size_t k = 0; k + 1 < curve.knot.size(); ++k)
    for (int i = 1; i <= parts; ++i)
      specimen.curve_curvature.push_back(curve.knot[k] + (curve.knot[k + 1] - curve.knot[k]) * i / parts);
  for (const double at : specimen.curve_curvature) specimen.curve_moment.push_back(curve.moment(at));
}

BentSense other_side(BentSense sense) {
  return sense == BentSense::face ? BentSense::back : BentSense::face;
}

// The curves of both senses by themselves, of a record that goes both ways, with the face outwards first. Zero of the
// moment and friction are in common. `sense`: of positive curvatures.
std::vector<BendingSpecimen> halves_of(const Record& record, BentSense sense, int pieces, bool alone) {
  BendingSpecimen whole{.name = record.rows.specimen};
  const BendingCurveFit fit =
      record.loop ? fit_loop(record, true, pieces, whole) : fit_once(record, true, pieces, whole);
  std::vector<BendingSpecimen> halves;
  for (const double sign : {1.0, -1.0}) {
    BendingSpecimen half{.name = whole.name, .sense = sign > 0.0 ? sense : other_side(sense)};
    for (std::size_t i = 0; i < record.rows.x.size(); ++i) {
      if (sign * record.rows.x[i] < 0.0) continue;
      half.curvature.push_back(record.rows.x[i]);
      half.moment.push_back(record.rows.y[i]);
    }
    half.reach =
        std::min(whole.reach, sign * *(sign > 0.0 ? std::max_element(half.curvature.begin(), half.curvature.end())
                                                  : std::min_element(half.curvature.begin(), half.curvature.end())));
    half.misfit = fit.misfit;
    half.friction = whole.friction;
    take_curve(sign > 0.0 ? fit.curve : fit.back, half);
    if (alone) add_errors(fit, half, sign < 0.0);
    halves.push_back(std::move(half));
  }
  if (sense == BentSense::back) std::swap(halves[0], halves[1]);
  return halves;
}

// Whether each sense has readings enough for a curve.
bool has_both(const Record& record) {
  const auto& x = record.rows.x;
  const auto up = std::count_if(x.begin(), x.end(), [](double curvature) { return curvature > 0.0; });
  const auto down = std::count_if(x.begin(), x.end(), [](double curvature) { return curvature < 0.0; });
  return std::min(up, down) >= static_cast<std::ptrdiff_t>(least_readings);
}

// The record in order, with what kind it is; what is done to its rows is noted.
Record record_of(Curve rows, const TestSpec& test, const Channel& x, const Channel& y, BendingSpecimen& specimen) {
  Record record{.rows = std::move(rows)};
  const std::vector<double>& curvature = record.rows.x;
  record.reach = greatest_size(curvature);
  if (!(record.reach > 0.0))
    throw InputError(fmt::format("{}: the curvature never leaves zero; choose another column", record.rows.specimen));
  check_signs(record.rows);
  if (!test.trust_units) ask_about_curvature(record.rows, test, record.reach);
  const auto [least, greatest] = std::minmax_element(curvature.begin(), curvature.end());
  record.two_senses = -*least > both_senses * record.reach && *greatest > both_senses * record.reach;
  const auto turns = turns_of(curvature, turn_share * (*greatest - *least));
  record.loop = turns.size() > 2 && curvature.size() >= rows_of_branch * (turns.size() - 1);
  if (record.loop) {
    specimen.notes.push_back(
        fmt::format("the record goes to and fro, in {} branches; friction is told from the curve "
                    "by Dahl's model",
                    turns.size() - 1));
    return record;
  }
  for (const double sign : {1.0, -1.0}) {
    if (!record.two_senses && (sign > 0.0) != (*greatest > -*least)) continue;
    const auto part = one_sense(record.rows, sign, x, y, specimen.notes);
    record.readings.insert(record.readings.end(), part.begin(), part.end());
  }
  note_senses(record.readings, specimen);
  return record;
}

BendingSpecimen table_specimen(Curve raw, const TestSpec& test, const FitSpec& spec, const Channel& x, const Channel& y,
                               bool alone) {
  BendingSpecimen specimen{.name = raw.specimen, .sense = test.sense, .notes = raw.notes};
  Curve rows = complete_rows(std::move(raw));
  rows.notes = {};
  if (test.specimen_width)
    for (double& moment : rows.y) moment /= *test.specimen_width;
  const Record record = record_of(std::move(rows), test, x, y, specimen);
  const int pieces = spec.bending_law.pieces;
  const BendingCurveFit fit =
      record.loop ? fit_loop(record, false, pieces, specimen) : fit_once(record, false, pieces, specimen);
  if (record.loop && specimen.friction)
    specimen.notes.push_back(fmt::format("friction of {:.4g} N over a rise of {:.4g} 1/mm: the loop is {:.4g} N wide",
                                         specimen.friction->moment, specimen.friction->rise,
                                         2.0 * specimen.friction->moment));
  if (record.loop) {
    specimen.curvature = record.rows.x;
    specimen.moment = record.rows.y;
  }
  for (const auto& reading : record.readings) {
    specimen.curvature.push_back(reading.curvature);
    specimen.moment.push_back(reading.moment);
  }
  take_curve(fit.curve, specimen);
  specimen.misfit = fit.misfit;
  if (std::abs(fit.offset) > friction_seen * greatest_size(record.rows.y))
    specimen.notes.push_back(fmt::format("the moment's zero is off by {:.3g} N; taken out", fit.offset));
  if (!test.trust_units) {
    const Quantity quantity = test.specimen_width ? Quantity::moment : Quantity::moment_per_length;
    // the secant over a twentieth: the tangent at zero itself rests on few readings
    const double first = fit.curve.moment(0.05 * specimen.reach) / (0.05 * specimen.reach);
    const auto plausible = [&](double ratio) { return plausible_stiffness(ratio * first, spec.area_weight()); };
    ask_about_stiffness(specimen.name, first, spec.area_weight(),
                        fmt::format("is moment_unit really '{}'{}, and curvature_unit '{}'", test.moment_unit,
                                    fitting_units(quantity, test.moment_unit, plausible), test.curvature_unit));
  }
  if (alone) add_errors(fit, specimen);
  if (record.two_senses) {
    if (test.sense != BentSense::both && has_both(record)) specimen.half = halves_of(record, test.sense, pieces, alone);
    specimen.sense = BentSense::both;
  }
  return specimen;
}

double interpolated(const std::vector<double>& x, const std::vector<double>& y, double at) {
  if (x.size() < 2) return 0.0;
  const auto above =
      std::clamp<std::ptrdiff_t>(std::lower_bound(x.begin(), x.end(), at) - x.begin(), 1, std::ssize(x) - 1);
  const double share = std::clamp((at - x[above - 1]) / (x[above] - x[above - 1]), 0.0, 1.0);
  return y[above - 1] + share * (y[above] - y[above - 1]);
}

}  // namespace

bool plausible_stiffness(double stiffness, double weight) {
  const double length = std::cbrt(stiffness / weight);
  return length > plausible_bending_length[0] && length < plausible_bending_length[1];
}

void ask_about_stiffness(const std::string& specimen, double stiffness, double weight, const std::string& question) {
  if (plausible_stiffness(stiffness, weight)) return;
  throw InputError(
      fmt::format("{}: the first stiffness is {:.3g} N mm, a bending length of {:.3g} mm for a fabric of "
                  "{:.3g} N/m^2, which none has; {}? if it is right, say trust_units = true",
                  specimen, stiffness, std::cbrt(stiffness / weight), weight * 1e6, question));
}

void add_errors(const BendingCurveFit& fit, BendingSpecimen& specimen, bool of_back) {
  constexpr Index least_left = 3;  // readings beyond the unknowns
  if (fit.sensitivity.rows() < fit.sensitivity.cols() + least_left) {
    specimen.notes.push_back(
        fmt::format("{} readings are too few to tell the error of a curve with {} unknowns; the band "
                    "has none of it",
                    fit.sensitivity.rows(), fit.sensitivity.cols()));
    return;
  }
  const CorrelatedErrors known = correlated_errors(fit.sensitivity, fit.residual);
  const auto tangents = static_cast<Index>(fit.error_knot.size());
  const Index first = of_back ? tangents : 0;
  specimen.freedom = known.freedom;
  for (int i = 0; i <= error_places; ++i) {
    const double curvature = specimen.reach * i / error_places;
    const Eigen::VectorXd g = curve_sensitivity(fit.error_knot, curvature);
    specimen.error_curvature.push_back(curvature);
    specimen.error.push_back(
        std::sqrt(std::max(0.0, g.dot(known.covariance.block(first, first, tangents, tangents) * g))));
  }
}

double moment_at(const BendingSpecimen& specimen, double curvature) {
  return interpolated(specimen.curve_curvature, specimen.curve_moment, curvature);
}

double error_at(const BendingSpecimen& specimen, double curvature) {
  return interpolated(specimen.error_curvature, specimen.error, curvature);
}

std::vector<BendingSpecimen> moment_curvature_specimens(const TestSpec& test, const FitSpec& spec, bool alone) {
  const Channel x{Quantity::curvature, "curvature", test.curvature_column, test.curvature_unit, test.curvature_factor};
  const Channel y{test.specimen_width ? Quantity::moment : Quantity::moment_per_length, "moment", test.moment_column,
                  test.moment_unit, test.moment_factor};
  std::vector<BendingSpecimen> specimens;
  for_each_specimen(test, spec.file, x, y, [&](Curve raw, std::size_t /*file*/) {
    specimens.push_back(table_specimen(std::move(raw), test, spec, x, y, alone));
  });
  for (auto& specimen : specimens) {
    specimen.name = name_beside(specimen.name, spec.file);
    for (auto& half : specimen.half) half.name = specimen.name;
  }
  return specimens;
}

}  // namespace weaveform::identify
