// A membrane of trusses has no bending stiffness, so that nothing but the cell gives its folds a length: refinement
// makes them shorter and more, and what follows from them (force, angle) does not converge. Any compression folds it,
// where a sheet of rigidity D (N mm) bears up to Euler's strain 4 pi^2 D / (E_c A/h L^2) between clamps at L
// (docs/stability.md).
#include <fmt/format.h>

#include <algorithm>

#include "core/keys/advice.hpp"
#include "post/trust/borders.hpp"

namespace weaveform {

double folded_share(const Summary& summary) {
  if (summary.forming) return summary.forming->wrinkles.area_share;
  return summary.folds ? summary.folds->zigzag_share : 0.0;
}

namespace {

// With bending a wave has a length of its own, which the mesh must be able to show (post/forming/waves.hpp).
void warn_of_short_waves(const FinishedRun& run, Warnings& warnings) {
  const Waves& waves = run.summary.waves;
  if (waves.are() != WavesOf::mesh) return;
  const auto& coarsening = run.scene.blank.coarsening;
  warnings.push_back(fmt::format(
      "wrinkles are {:.3g} mm long, {:.2g} cells a wave, and fewer than {:g} make them the mesh's: believe that it "
      "wrinkles, not how; set blank.coarsening to {:.2g} or less",
      waves.all.wavelength, waves.all.cells, least_cells_per_wave,
      rounded_down(std::max(coarsening[0], coarsening[1]) * waves.all.cells / least_cells_per_wave, 2)));
}

}  // namespace

void warn_of_folds_of_the_mesh(const FinishedRun& run, Warnings& warnings) {
  const double share = folded_share(run.summary);
  if (has_bending(run.scene.model)) return warn_of_short_waves(run, warnings);
  if (share <= 0.0) return;
  warnings.push_back(
      fmt::format("{:.3g} % of the area is wrinkled and the model has no bending stiffness: the folds are as short as "
                  "its cells and grow with refinement; believe that it wrinkles, not how, and set model.cell = "
                  "\"rotation-free\" or \"shell\"",
                  100.0 * share));
}

}  // namespace weaveform
