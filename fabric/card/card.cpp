#include "fabric/card/card.hpp"

#include <cmath>

namespace weaveform {

double Card::area_density() const {
  return yarn[0].linear_density / yarn[0].interval + yarn[1].linear_density / yarn[1].interval;
}

double strain_at_stress(const TangentLaw& law, double stress) {
  double low = 0.0, high = 1.0;  // stress does not fall with strain: cards whose tangent turns negative are refused
  while (std::nextafter(low, high) < high) {
    const double middle = 0.5 * (low + high);
    (law.stress(middle) < stress ? low : high) = middle;
  }
  return high;
}

}  // namespace weaveform
