// What the mesh does to the load of a bias extension: lines that do not meet the ends of the grips bound other zones than
// the specimen has, and trusses, which do not bend in the fabric's plane, leave the zones' borders as wide as a cell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/keys/advice.hpp"
#include "post/measure/bias_extension.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

// Loads of lines at eight phases lie within this many times the cell's side over the specimen's width of the fitted
// ones (plain weave -26 to +9 % at a side of 0.17 widths, -13 to +7 % at 0.09; twill 13 % at 0.12, 5 % at 0.06).
constexpr double per_side = 1.5;

// Of the load above its limit, over the cell's side over the width: 0.93, 0.75, 0.50 for the plain weave at coarsening 1, 2
// and 4 (limit 8.87 N), 0.69, 0.61, 0.56 for the twill (21.2 N), both by Richardson; docs/bias_extension.md.
constexpr double error_per_side = 0.8;
constexpr double greatest_error = 0.025;

// Where yarns stretch so little that borders are jumps, the mesh is worth nothing: linear laws, stiffened ones, small
// angles.
constexpr double least_angle_deg = 25.0;
bool has_stretched_borders(const FinishedRun& run) {
  const ModelSpec& model = run.scene.model;
  return model.yarn != YarnElement::beam && model.yarn_law == YarnLaw::card && model.yarn_stiffness_scale <= 1.0 &&
         run.summary.statistics.max_shear_angle_deg > least_angle_deg;
}

bool lines_are_fitted(const BlankSpec& blank) {
  return blank.fit == LineFit::grips && !blank.on_roll && blank.phase == BlankSpec{}.phase;
}

// The coarsening that gives cells of this side (mm) at most, whatever fitting lines to the grips' ends makes of them: it
// moves the width/sqrt(2)/side lines between two ends by half a spacing at most, and the mesh at hand, itself fitted,
// does not tell by how much.
double coarsening_for(double side, double width, const FinishedRun& run) {
  const auto& coarsening = run.scene.blank.coarsening;
  const double asked = std::sqrt(run.card.yarn[0].interval * coarsening[0] * run.card.yarn[1].interval * coarsening[1]);
  const double fitted = 1.0 + side / (std::numbers::sqrt2 * width);
  return rounded_down(std::max(coarsening[0], coarsening[1]) * side / (asked * fitted), 2);
}

}  // namespace

void warn_of_bias_extension_mesh(const FinishedRun& run, Warnings& warnings) {
  const auto specimen = find_bias_extension(run.scene);
  if (!specimen) return;
  const double side = std::sqrt(run.mesh.spacing[0] * run.mesh.spacing[1]);
  if (!lines_are_fitted(run.scene.blank))
    warnings.push_back(fmt::format(
        "yarn lines are not fitted to the grips' ends, which bound the zones of a bias extension: with cells of {:.3g} "
        "mm on a width of {:.4g} mm the load moves with the lines' phase by up to {:.2g} % of it; set blank.fit = "
        "\"grips\", phase 0, or blank.coarsening finer",
        side, specimen->width, 100.0 * per_side * side / specimen->width));
  const double error = error_per_side * side / specimen->width;
  if (!has_stretched_borders(run) || error <= greatest_error) return;
  warnings.push_back(fmt::format(
      "the zones' borders are as wide as a cell: with yarns that do not bend in the fabric's plane the load is "
      "about {:.2g} % above that of ever finer cells (now {:.3g} mm; limit {:.2g} %); set blank.coarsening to {:.2g} "
      "or less, or "
      "model.yarn = \"beam\", whose borders have a width of their own",
      100.0 * error, side, 100.0 * greatest_error,
      coarsening_for(greatest_error / error_per_side * specimen->width, specimen->width, run)));
}

}  // namespace weaveform
