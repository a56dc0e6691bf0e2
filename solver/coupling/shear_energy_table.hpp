// The shear energy w(s) of a card for inner loops: a cubic Hermite table over the logarithmic strain with the law's own
// slopes. Value and slope that are given are those of the table, so that forces from the one are exactly the derivative of
// the other; from the law they differ by step^4/384 of its fourth derivative.
#pragma once

#include <vector>

#include "fabric/law/shear_law.hpp"
#include "solver/element/half_log.hpp"

namespace weaveform {

class ShearEnergyTable {
public:
  explicit ShearEnergyTable(const ShearCard& card);

  struct Entry {
    double energy = 0.0;  // mJ/mm^3
    double stress = 0.0;  // MPa; d energy / d|s|
  };
  // At |s| = |sin gamma| <= 1 - 1e-12. From 87.9 deg on the energy keeps its slope over the strain.
  [[nodiscard]] inline Entry at(double size) const {
    const double strain = half_log<double>(1.0 + size, 1.0 - size);
    const double place = strain * per_strain;
    const int n = place < last ? static_cast<int>(place) : last;
    const double t = place - n;
    const double rise = value_[n + 1] - value_[n];
    const double a = slope_[n], b = 3.0 * rise - 2.0 * slope_[n] - slope_[n + 1],
                 c = slope_[n] + slope_[n + 1] - 2.0 * rise;
    const double energy = value_[n] + t * (a + t * (b + t * c));
    const double slope = a + t * (2.0 * b + t * 3.0 * c);
    return {energy, slope * per_strain / (1.0 - size * size)};  // d strain / d s = 1/(1 - s^2)
  }

private:
  static constexpr double per_strain = 512.0;
  static constexpr int last = 4 * 512 - 1;  // intervals, from zero
  std::vector<double> value_, slope_;       // mJ/mm^3, and per interval
};

}  // namespace weaveform
