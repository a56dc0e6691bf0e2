// A card's shear law is meant to hold up to an angle; beyond it only its last tangent speaks.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "post/trust/borders.hpp"

namespace weaveform {
namespace {

Vec3 centre_of(const Mesh& mesh, std::size_t cell) {
  Vec3 sum = {0.0, 0.0, 0.0};
  const int from = mesh.cells.offset[cell], to = mesh.cells.offset[cell + 1];
  for (int k = from; k < to; ++k)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += mesh.flat_positions()[mesh.cells.node[k]][c] / (to - from);
  return sum;
}

}  // namespace

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
  const Vec3 place = centre_of(run.mesh, most);
  warnings.push_back(fmt::format(
      "{} of {} cells are sheared beyond the {:g} degrees to which the card's shear law is meant to hold, up to {:.3g} "
      "degrees in cell {} at ({:.4g}, {:.4g}, {:.4g}) mm of the flat blank; form less, or give the card a shear law "
      "measured so far",
      beyond, run.end.shear_angle.size(), limit, greatest, most, place[0], place[1], place[2]));
}

}  // namespace weaveform
