// A membrane of trusses has no bending stiffness, so that nothing but the cell gives its folds a length: refinement
// makes them shorter and more, and what follows from them (force, angle) does not converge.
#include <fmt/format.h>

#include "post/trust/borders.hpp"

namespace weaveform {

void warn_of_folds_of_the_mesh(const FinishedRun& run, Warnings& warnings) {
  const auto& forming = run.summary.forming;
  if (!forming || forming->has_bending || forming->wrinkles.area_share <= 0.0) return;
  warnings.push_back(
      fmt::format("{:.3g} % of the area is wrinkled and the model has no bending stiffness: the folds are as short as "
                  "its cells and grow with refinement; believe that it wrinkles, not how, and set model.cell = "
                  "\"rotation-free\" or \"shell\"",
                  100.0 * forming->wrinkles.area_share));
}

}  // namespace weaveform
