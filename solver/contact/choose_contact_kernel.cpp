#include "core/instructions/choose_loops.hpp"
#include "solver/contact/contact_kernel.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(ContactLoops, contact_loops)

ContactSums contact_forces(const ContactLaw& law, const ContactTool& tool, const Distances& distances, double time,
                           const ContactNodes& nodes) {
  const auto& forces =
      nodes.swell == nullptr ? chosen_contact_loops().contact_forces : chosen_contact_loops().swollen_contact_forces;
  return forces(law, tool, distances, time, nodes);
}

void reset_anchors(const ContactTool& tool, const ContactNodes& nodes) {
  chosen_contact_loops().reset_anchors(tool, nodes);
}

double least_gap(const Distances& distances, double offset, const ContactNodes& nodes) {
  const auto& gap =
      nodes.swell == nullptr ? chosen_contact_loops().least_gap : chosen_contact_loops().swollen_least_gap;
  return gap(distances, offset, nodes);
}

double greatest_speed(const std::array<double, 3>& reference, const ContactNodes& nodes) {
  return chosen_contact_loops().greatest_speed(reference, nodes);
}

}  // namespace weaveform
