// Nodes that touch a tool, as contact's kernels see them.
#pragma once

#include <array>
#include <vector>

#include "solver/contact/contact_kernel.hpp"

namespace weaveform::test {

struct TouchingNodes {
  std::array<std::vector<double>, 3> x, v, anchor, drag, force;  // mm, mm/s, mm, N, N
  std::vector<double> node_mass, area;                           // tonne, mm^2

  [[nodiscard]] ContactNodes view(int first, int nodes) {
    ContactNodes seen{};
    seen.count = nodes;
    seen.mass = node_mass.data() + first;
    seen.area = area.data() + first;
    for (int c = 0; c < 3; ++c) {
      seen.x[c] = x[c].data() + first;
      seen.v[c] = v[c].data() + first;
      seen.force[c] = force[c].data() + first;
      seen.anchor[c] = anchor[c].data() + first;
      seen.drag[c] = drag[c].data() + first;
    }
    return seen;
  }
};

// All groups of a block of `nodes`.
inline ContactGroups groups_of(int nodes) {
  ContactGroups groups;
  for (int n = 0; n < nodes; n += group_nodes) groups.add(n, n);
  return groups;
}

}  // namespace weaveform::test
