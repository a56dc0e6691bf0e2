#include "core/instructions/choose_loops.hpp"
#include "solver/contact/contact_kernel.hpp"

namespace weaveform {

WEAVEFORM_CHOOSE_LOOPS(ContactLoops, contact_loops)

ContactSums contact_forces(const ContactLaw& law, const ContactTool& tool, const Distances& distances, double time,
                           const ContactNodes& nodes, const ContactGroups& groups) {
  const auto& forces =
      nodes.swell == nullptr ? chosen_contact_loops().contact_forces : chosen_contact_loops().swollen_contact_forces;
  return forces(law, tool, distances, time, nodes, groups);
}

void least_gaps(const Distances& distances, double offset, const ContactNodes& nodes, const ContactGroups& groups,
                double (&gap)[groups_in_block]) {
  const auto& gaps =
      nodes.swell == nullptr ? chosen_contact_loops().least_gaps : chosen_contact_loops().swollen_least_gaps;
  gaps(distances, offset, nodes, groups, gap);
}

void find_upright(const Distances& distances, int count, ContactGroups& groups) {
  chosen_contact_loops().find_upright(distances, count, groups);
}

double greatest_speed(const std::array<double, 3>& reference, const ContactNodes& nodes) {
  return chosen_contact_loops().greatest_speed(reference, nodes);
}

}  // namespace weaveform
