#include "fabric/trellis/tension_shear.hpp"

#include <algorithm>

namespace weaveform {

TensionedShear shear_at_strain(const Card& card, double angle, const std::array<double, 2>& strain) {
  const double log_strain = log_shear_strain(angle);
  const double shortening = 0.5 * card.shear.tension_coupling * card.thickness * shear_energy(card.shear, log_strain);
  TensionedShear found;
  for (std::size_t f = 0; f < 2; ++f) {
    found.shortening[f] = shortening;
    found.tension[f] = card.yarn[f].section / card.yarn[f].interval *
                       std::max(0.0, card.yarn[f].tension.stress(strain[f] + shortening));
  }
  found.stress = shear_stress_at_tension(card, angle, found.tension);
  return found;
}

double shear_stress_at_tension(const Card& card, double angle, const std::array<double, 2>& tension) {
  const double mean = 0.5 * (tension[0] + tension[1]);
  return shear_stress(card.shear, log_shear_strain(angle)) * (1.0 + card.shear.tension_coupling * mean);
}

}  // namespace weaveform
