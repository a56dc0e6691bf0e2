// A card's shear law is meant to hold up to an angle; beyond it only its last tangent speaks.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "post/trust/borders.hpp"

namespace weaveform {
void warn_of_shear_beyond_card(const FinishedRun& run, Warnings& warnings) {
  const double limit = run.card.shear.valid_to_deg;
  double greatest = 0.0;  // deg
  std::size_t beyond = 0, most = 0;
  for (std::size_t c = 0; c < run.end.shear_angle.size(); ++c) {
    const double angle = std::abs(run.end.shear_angle[c]) * 180.0 / std::numbers::pi;
    if (!(angle > limit)) continue;
    ++beyond;
    if (angle <= greatest) continue;
    greatest = angle;
    most = c;
  }
  if (beyond == 0) return;
  const Vec3 place = cell_centre(run.mesh.cells, static_cast<int>(most), run.mesh.flat_positions());
  warnings.push_back(fmt::format(
      "{} of {} cells are sheared beyond the {:g} degrees to which the card's shear law is meant to hold, up to {:.3g} "
      "degrees in cell {} at ({:.4g}, {:.4g}, {:.4g}) mm of the flat blank; form less, or give the card a shear law "
      "measured so far",
      beyond, run.end.shear_angle.size(), limit, greatest, most, place[0], place[1], place[2]));
}

}  // namespace weaveform
