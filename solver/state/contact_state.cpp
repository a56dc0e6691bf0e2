#include "solver/state/contact_state.hpp"

#include <cstddef>

#include "core/vector/append.hpp"

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

void append(ContactState& all, const ContactState& more) {
  append(all.tool, more.tool);
  append(all.count, more.count);
  append(all.force, more.force);
  append(all.pressure, more.pressure);
  append(all.gap, more.gap);
  append(all.friction, more.friction);
}

}  // namespace weaveform
