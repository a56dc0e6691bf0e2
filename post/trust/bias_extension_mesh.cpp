// What the mesh does to the load of a bias extension: lines that do not meet the ends of the grips bound other zones than
// the specimen has, and trusses, which do not bend in the fabric's plane, leave the zones' borders as wide as a cell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/keys/advice.hpp"
#include "post/measure/bias_extension.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

// Loads of lines at eight phases lie within this many times the cell's side over the specimen's width of the fitted
// ones (plain weave -26 to +9 % at a side of 0.17 widths, -13 to +7 % at 0.09; twill 13 % at 0.12, 5 % at 0.06).
constexpr double per_side = 1.5;

// Of the load, for a side of one length sqrt(G t h/EA) l of the borders' stretch: docs/bias_extension.md. The plain weave's
// series over cells of 20 to 1.2 mm, whose borders are 1.5 mm wide, follows 2.0 % (h/1.5 mm)^0.6 within 0.4 %.
constexpr double error_at_layer = 0.020, order = 0.6, layer = 1.5;  // layer: mm
constexpr double greatest_error = 0.03;

bool lines_are_fitted(const BlankSpec& blank) {
  return blank.fit == LineFit::grips && !blank.on_roll && blank.phase == BlankSpec{}.phase;
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
  const double error = error_at_layer * std::pow(side / layer, order);
  if (run.scene.model.yarn == YarnElement::beam || error <= greatest_error) return;
  warnings.push_back(fmt::format(
      "the zones' borders are as wide as a cell: with yarns that do not bend in the fabric's plane the load is about "
      "{:.2g} "
      "% above that of ever finer cells (now {:.3g} mm; limit {:.2g} %); set blank.coarsening to {:.2g} or less, or "
      "model.yarn = \"beam\", whose borders have a width of their own",
      100.0 * error, side, 100.0 * greatest_error,
      rounded_down(std::max(run.scene.blank.coarsening[0], run.scene.blank.coarsening[1]) *
                       std::pow(greatest_error / error, 1.0 / order),
                   2)));
}

}  // namespace weaveform
