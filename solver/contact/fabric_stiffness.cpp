#include "solver/contact/fabric_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/contact.hpp"

namespace weaveform {

double tool_contact_frequency(const AnalysisSpec& analysis, const Card& card, double fabric_step) {
  const double by_step = contact_frequency(analysis, fabric_step);
  const auto own = [&](double stiffness) { return std::sqrt(stiffness / (card.area_density() * analysis.mass_scale)); };
  const bool factor_given = analysis.contact_stiffness.has_value();
  if (!card.through_thickness_stiffness)
    return factor_given ? by_step : std::min(own(usual_thickness_stiffness), by_step);
  const double stated = own(*card.through_thickness_stiffness);
  return factor_given ? std::min(stated, by_step) : stated;
}

}  // namespace weaveform
