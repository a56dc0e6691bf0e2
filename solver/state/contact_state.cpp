#include "solver/state/contact_state.hpp"

#include <cstddef>

namespace weaveform {

ContactState unfolded(const ContactState& part, const std::vector<int>& source, const std::vector<double>& factor) {
  ContactState whole;
  for (std::size_t n = 0; n < source.size(); ++n) {
    const int from = source[n];
    whole.tool.push_back(part.tool[from]);
    whole.count.push_back(part.count[from]);
    whole.force.push_back(factor[n] * part.force[from]);
    whole.pressure.push_back(part.pressure[from]);
    whole.gap.push_back(part.gap[from]);
    whole.friction.push_back(part.friction[from]);
  }
  return whole;
}

}  // namespace weaveform
