#include "solver/ply/strain_error.hpp"

#include <algorithm>
#include <cmath>

#include "solver/element/yarn_law.hpp"
#include "solver/ply/reach.hpp"

namespace weaveform {
double nominal_stress(const TangentLaw& law, double strain, bool constant_section) {
  return law.stress(strain) * (constant_section ? 1.0 : std::exp(-strain));
}

// N rises with e as long as C > s, which holds for any yarn that can be pulled taut. Halves [0, torn] 50 times.
double strain_under(const TangentLaw& law, double nominal, bool constant_section) {
  double low = 0.0, high = torn_strain;
  for (int halving = 0; halving < 50; ++halving) {
    const double middle = 0.5 * (low + high);
    (nominal_stress(law, middle, constant_section) < nominal ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double yarn_strain_error(const Mesh& mesh, const Card& card, const ModelSpec& model,
                         const std::vector<double>& strain) {
  if (model.yarn_stiffness_scale == 1.0 || strain.empty()) return 0.0;
  ModelSpec real = model;
  real.yarn_stiffness_scale = 1.0;
  const auto scaled_laws = yarn_laws(card, model), real_laws = yarn_laws(card, real);
  const bool constant_section = model.section == Section::constant;
  double greatest = 0.0;
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const std::size_t f = mesh.yarns.family[e] == Family::warp ? 0 : 1;
    const double nominal = nominal_stress(scaled_laws[f], strain[e], constant_section);
    if (nominal <= 0.0) continue;
    greatest = std::max(greatest, std::abs(strain[e] - strain_under(real_laws[f], nominal, constant_section)));
  }
  return greatest;
}

}  // namespace weaveform
