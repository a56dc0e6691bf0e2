#include "fabric/identify/shear_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "fabric/identify/curve.hpp"
#include "fabric/trellis/bias_rectangle.hpp"
#include "fabric/trellis/shear_frame.hpp"

namespace weaveform::identify {
namespace {

constexpr double least_reach = 5.0 * degree;                      // rad; a test of shear goes further
constexpr double right_angle = 0.5 * std::numbers::pi;            // rad
constexpr std::array<double, 2> plausible_force = {1e-3, 100.0};  // N/mm; greatest shear force of any woven fabric
constexpr double reliable_angle = 40.0 * degree;                  // rad; kinematic angles of bias tests err beyond

// Whether a test that shears to this angle can be what it is said to be.
bool plausible_reach(double angle) {
  return angle > least_reach && angle < right_angle;
}

using AngleOf = std::function<double(double displacement)>;  // rad; not a number past 90 deg

void ask_about_angle(const Curve& curve, const TestSpec& test, const AngleOf& angle_of) {
  const auto plausible = [&](double ratio) { return plausible_reach(angle_of(ratio * curve.x.back())); };
  const double reach = angle_of(curve.x.back());
  const std::string what = std::isfinite(reach)
                               ? fmt::format("the specimen is sheared by {:.3g} deg only", reach / degree)
                               : std::string("the trellis would be sheared past 90 deg");
  throw InputError(
      fmt::format("{}: at a displacement of {:.4g} mm {}; is displacement_unit really '{}'{}, and the size "
                  "of the specimen right? if it is right, say trust_units = true",
                  curve.specimen, curve.x.back(), what, test.displacement_unit,
                  fitting_units(Quantity::length, test.displacement_unit, plausible)));
}

void ask_about_force(const std::string& specimen, double force_per_length, Quantity quantity, const std::string& key,
                     const std::string& unit) {
  const auto plausible = [&](double ratio) {
    return force_per_length * ratio > plausible_force[0] && force_per_length * ratio < plausible_force[1];
  };
  if (plausible(1.0)) return;
  throw InputError(
      fmt::format("{}: the greatest force per width is {:.3g} N/mm, which no fabric has; is {} really '{}'{}, "
                  "and the size of the specimen right? if it is right, say trust_units = true",
                  specimen, force_per_length, key, unit, fitting_units(quantity, unit, plausible)));
}

// Machine columns by Eqs. 12 and 13.
ShearSpecimen frame_specimen(const Curve& curve, const TestSpec& test, double thickness) {
  const ShearFrame frame{*test.frame_length, *test.fabric_length};
  const AngleOf angle_of = [&](double displacement) { return frame_shear_angle(frame, displacement); };
  const double reach = angle_of(curve.x.back());
  if (!std::isfinite(reach) || !(reach < right_angle) || (!test.trust_units && !plausible_reach(reach)))
    ask_about_angle(curve, test, angle_of);
  ShearSpecimen specimen{
      .name = curve.specimen, .angle = {}, .value = {}, .grid = {}, .notes = curve.notes, .frame = frame};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    specimen.angle.push_back(angle_of(curve.x[i]));
    specimen.value.push_back(normalised_shear_force(frame, curve.y[i], specimen.angle.back()) / thickness);
  }
  if (!test.trust_units) {
    const double greatest = *std::max_element(specimen.value.begin(), specimen.value.end()) * thickness;
    ask_about_force(specimen.name, greatest, Quantity::force, "force_unit", test.force_unit);
  }
  return specimen;
}

// Columns that already are the angle and the normalised force.
ShearSpecimen derived_specimen(const Curve& curve, const TestSpec& test, double thickness) {
  ShearSpecimen specimen{.name = curve.specimen, .angle = curve.x, .value = {}, .grid = {}, .notes = curve.notes};
  if (test.frame_length && test.fabric_length) specimen.frame = ShearFrame{*test.frame_length, *test.fabric_length};
  const double reach = curve.x.back();
  if (!(reach < right_angle) || (!test.trust_units && !plausible_reach(reach))) {
    const auto plausible = [&](double ratio) { return plausible_reach(ratio * reach); };
    throw InputError(fmt::format(
        "{}: the shear angle goes to {:.4g} deg; is angle_unit really '{}'{}? a fabric shears by "
        "less than 90 deg, a test by more than 5",
        curve.specimen, reach / degree, test.angle_unit, fitting_units(Quantity::angle, test.angle_unit, plausible)));
  }
  for (const double force : curve.y) specimen.value.push_back(force / thickness);
  if (!test.trust_units)
    ask_about_force(specimen.name, *std::max_element(curve.y.begin(), curve.y.end()), Quantity::force_per_length,
                    "normalised_force_unit", test.normalised_force_unit);
  return specimen;
}

std::vector<ShearSpecimen> frame_specimens(const TestSpec& test, const FitSpec& spec) {
  const bool machine = !test.displacement_column.empty();
  const Channel angle{Quantity::angle, "angle", test.angle_column, test.angle_unit, test.angle_factor};
  const Channel force{Quantity::force_per_length, "normalised_force", test.normalised_force_column,
                      test.normalised_force_unit, test.normalised_force_factor};
  std::vector<ShearSpecimen> specimens;
  for (const auto& curve : load_curves(test, spec.file, machine ? displacement_channel(test) : angle,
                                       machine ? force_channel(test) : force)) {
    specimens.push_back(machine ? frame_specimen(curve, test, spec.thickness())
                                : derived_specimen(curve, test, spec.thickness()));
  }
  return specimens;
}

// Rows past the travel at which a trellis of pinned yarns would be closed tell of slip alone.
void cut_past_right_angle(Curve& curve, const TestSpec& test, const AngleOf& angle_of) {
  const auto kept = static_cast<std::size_t>(
      std::find_if(curve.x.begin(), curve.x.end(), [&](double travel) { return !(angle_of(travel) < right_angle); }) -
      curve.x.begin());
  if (kept == curve.x.size()) return;
  if (!test.trust_units && 2 * kept < curve.x.size()) ask_about_angle(curve, test, angle_of);
  curve.notes.push_back(
      fmt::format("the {} rows past {:.4g} mm, where pinned yarns would be sheared by 90 deg, left out",
                  curve.x.size() - kept, curve.x[kept]));
  curve.x.resize(kept);
  curve.y.resize(kept);
}

ShearSpecimen bias_specimen(Curve curve, const TestSpec& test) {
  const BiasRectangle rectangle{*test.width, *test.length};
  const AngleOf angle_of = [&](double travel) { return bias_shear_angle(rectangle, travel); };
  cut_past_right_angle(curve, test, angle_of);
  if (curve.x.empty() || (!test.trust_units && !plausible_reach(angle_of(curve.x.back()))))
    ask_about_angle(curve, test, angle_of);
  ShearSpecimen specimen{
      .name = curve.specimen, .angle = {}, .value = curve.y, .grid = {}, .notes = curve.notes, .rectangle = rectangle};
  for (const double travel : curve.x) specimen.angle.push_back(angle_of(travel));
  if (!test.trust_units)
    ask_about_force(specimen.name, *std::max_element(curve.y.begin(), curve.y.end()) / rectangle.width, Quantity::force,
                    "force_unit", test.force_unit);
  return specimen;
}

// Weights of the two stresses in the value at an angle, for the specimen of that index.
using WeightsOf = std::function<BiasLoadWeights(std::size_t specimen, double angle)>;

void fill_grids(std::vector<ShearSpecimen>& specimens, const std::vector<double>& grid, double step,
                const WeightsOf& weights_of) {
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    for (const double angle : grid) {
      const BiasLoadWeights weights = weights_of(k, angle);
      const double value = local_value(specimens[k].angle, specimens[k].value, angle, 0.5 * step);
      specimens[k].grid.push_back({angle, weights.full, weights.half, value});
    }
  }
}

ShearFit fitted(std::vector<ShearSpecimen> specimens, const FitSpec& spec, std::vector<std::string> warnings) {
  ShearFit fit = fit_shear(std::move(specimens), spec.shear.degree, spec.shear.form, spec.confidence());
  fit.warnings.insert(fit.warnings.begin(), warnings.begin(), warnings.end());
  return fit;
}

std::array<double, 2> in_radians(const std::array<double, 2>& range) {
  return {range[0] * degree, range[1] * degree};
}

}  // namespace

ShearFit fit_shear_frames(const FitSpec& spec) {
  std::vector<ShearSpecimen> specimens;
  for (const auto& test : spec.shear_frame) {
    auto more = frame_specimens(test, spec);
    std::move(more.begin(), more.end(), std::back_inserter(specimens));
  }
  std::optional<std::array<double, 2>> range;
  if (spec.shear.angles) range = in_radians(*spec.shear.angles);
  std::vector<std::string> warnings;
  const double step = spec.shear.angle_step * degree;
  const auto grid = common_grid(specimens, range, step, warnings);
  fill_grids(specimens, grid, step, [](std::size_t, double) { return BiasLoadWeights{1.0, 0.0}; });
  return fitted(std::move(specimens), spec, std::move(warnings));
}

ShearFit fit_bias_extensions(const FitSpec& spec) {
  std::vector<ShearSpecimen> specimens;
  for (const auto& test : spec.bias_extension) {
    for (auto& curve : load_curves(test, spec.file, displacement_channel(test), force_channel(test)))
      specimens.push_back(bias_specimen(std::move(curve), test));
  }
  std::vector<std::string> warnings;
  const double step = spec.shear.angle_step * degree;
  const auto grid = common_grid(specimens, in_radians(spec.shear.bias_angles), step, warnings);
  fill_grids(specimens, grid, step, [&](std::size_t k, double angle) {
    return bias_load_weights(*specimens[k].rectangle, spec.thickness(), angle);
  });
  if (grid.back() > reliable_angle)
    warnings.push_back(
        fmt::format("bias extension fitted to {:.0f} deg of kinematic angle; where yarns slip the true "
                    "angle stays below it, so the law is softer than the fabric beyond some 25 to 40 deg",
                    grid.back() / degree));
  return fitted(std::move(specimens), spec, std::move(warnings));
}

}  // namespace weaveform::identify
