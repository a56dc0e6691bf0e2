// Every formulation and thickness rule returns the card's shear force only up to some angle; the closed forms of
// docs/unit_cell.md tell that angle for any card.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "post/trust/borders.hpp"
#include "post/unit_cell/closed_form.hpp"
#include "post/unit_cell/study.hpp"

namespace weaveform {

void warn_of_formulation(const FinishedRun& run, Warnings& warnings) {
  const ModelSpec& model = run.scene.model;
  const double degree = std::numbers::pi / 180.0;
  const double border = formulation_holds_to(run.card.shear, model.formulation, model.thickness, unit_cell_tolerance);
  const double reached = run.summary.statistics.max_shear_angle_deg * degree;
  if (reached <= border) return;
  const double error = closed_form_ratio(run.card.shear, model.formulation, model.thickness, reached) - 1.0;
  warnings.push_back(
      fmt::format("cells shear to {:.1f} deg, but formulation \"{}\" with thickness \"{}\" returns this card's shear "
                  "force within {:g} % only to {:.1f} deg; at {:.1f} deg it is off by {:+.0f} %; formulation = "
                  "\"energy\" with thickness = \"constant-volume\" returns it at every angle",
                  reached / degree, name_of(model.formulation), name_of(model.thickness), 100.0 * unit_cell_tolerance,
                  border / degree, reached / degree, 100.0 * error));
}

}  // namespace weaveform
