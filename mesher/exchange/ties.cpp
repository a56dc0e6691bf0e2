#include "mesher/exchange/ties.hpp"

#include <map>

namespace weaveform::foreign {

namespace {

std::vector<char> bound_nodes(const Gathered& model) {
  std::vector<char> bound(model.mesh.node_count(), 0);
  for (const auto& grip : model.grips) {
    const int set = model.set_number(grip.set);
    if (set == 0 || !(grip.displacement[0] || grip.displacement[1] || grip.displacement[2])) continue;
    for (const int n : model.sets[static_cast<std::size_t>(set) - 1].node) bound[n] = 1;
  }
  return bound;
}

}  // namespace

FreeTies free_ties(const Gathered& model) {
  const std::vector<char> bound = bound_nodes(model);
  FreeTies ties;
  std::map<int, int> follower_of;
  for (MeshTie tie : model.mesh.tie) {
    if (bound[tie.node]) {
      ++ties.dropped;
      continue;
    }
    for (int& to : tie.to) {
      if (!bound[to]) continue;
      const int next = model.mesh.node_count() + static_cast<int>(ties.follower.size());
      const auto [found, added] = follower_of.emplace(to, next);
      if (added) ties.follower.push_back(to);
      to = found->second;
    }
    ties.tie.push_back(tie);
  }
  return ties;
}

}  // namespace weaveform::foreign
