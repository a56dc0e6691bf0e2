#include "solver/contact/fabric_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/contact.hpp"

namespace weaveform {

double tool_contact_frequency(const AnalysisSpec& analysis, const Card& card, double fabric_step) {
  const double by_step = contact_frequency(analysis, fabric_step);
  const double stiffness = card.through_thickness_stiffness.value_or(usual_thickness_stiffness);
  const double own = std::sqrt(stiffness / (card.area_density() * analysis.mass_scale));
  const bool as_it_stands = card.through_thickness_stiffness && !analysis.contact_stiffness;
  return as_it_stands ? own : std::min(own, by_step);
}

}  // namespace weaveform
