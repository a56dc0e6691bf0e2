// The yarn's effective section, Eq. 11 of the paper.
#pragma once

namespace weaveform {

// Eq. 11: A = rho_yarn / (V_f rho_fibre + (1 - V_f) rho_matrix), mm^2, from tonne/mm and tonne/mm^3; no voids assumed.
[[nodiscard]] double section_from_densities(double linear_density, double fibre_volume_fraction, double fibre_density,
                                            double matrix_density);

}  // namespace weaveform
