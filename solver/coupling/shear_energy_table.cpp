#include "solver/coupling/shear_energy_table.hpp"

#include <cmath>

namespace weaveform {

ShearEnergyTable::ShearEnergyTable(const ShearCard& card) {
  for (int n = 0; n <= last + 1; ++n) {
    const double strain = n / per_strain, cosine = 1.0 / std::cosh(strain);
    value_.push_back(shear_energy(card, strain));
    slope_.push_back(shear_stress(card, strain) * cosine * cosine / per_strain);
  }
}

}  // namespace weaveform
