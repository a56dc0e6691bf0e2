#include "fabric/card/yarn_section.hpp"

namespace weaveform {

double section_from_densities(double linear_density, double fibre_volume_fraction, double fibre_density,
                              double matrix_density) {
  return linear_density / (fibre_volume_fraction * fibre_density + (1.0 - fibre_volume_fraction) * matrix_density);
}

}  // namespace weaveform
