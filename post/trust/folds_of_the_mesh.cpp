// A membrane of trusses has no bending stiffness, so that nothing but the cell gives its folds a length: refinement
// makes them shorter and more, and what follows from them (force, angle) does not converge. Any compression folds it,
// where a sheet of rigidity D (N mm) bears up to Euler's strain 4 pi^2 D / (E_c A/h L^2) between clamps at L
// (docs/stability.md).
#include <fmt/format.h>

#include "post/trust/borders.hpp"

namespace weaveform {

double folded_share(const Summary& summary) {
  if (summary.forming) return summary.forming->wrinkles.area_share;
  return summary.folds ? summary.folds->zigzag_share : 0.0;
}

void warn_of_folds_of_the_mesh(const FinishedRun& run, Warnings& warnings) {
  const double share = folded_share(run.summary);
  if (run.scene.model.yarn == YarnElement::beam || run.scene.model.cell != CellElement::membrane || share <= 0.0)
    return;
  warnings.push_back(
      fmt::format("{:.3g} % of the area is wrinkled and the model has no bending stiffness: the folds are as short as "
                  "its cells and grow with refinement; believe that it wrinkles, not how, and set model.cell = "
                  "\"rotation-free\" or \"shell\"",
                  100.0 * share));
}

}  // namespace weaveform
