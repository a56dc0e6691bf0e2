#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/contact.hpp"

namespace weaveform {
namespace {

// At Coulomb's limit, but for the rounding of the cut.
constexpr double limit_tolerance = 1e-9;

struct NodeContact {
  double normal = 0.0;  // N
  FrictionState friction = FrictionState::none;
};

// The contact law once more at one node, whose anchor has followed already: the same normal force, and a node that
// slides is cut to the limit again.
NodeContact node_contact(const ContactLaw& law, const ContactTool& tool, const Distances& found, ContactNodes node) {
  double force[3] = {0.0, 0.0, 0.0}, anchor[3], drag[3] = {0.0, 0.0, 0.0};
  for (int c = 0; c < 3; ++c) {
    anchor[c] = *node.anchor[c];
    node.force[c] = &force[c];
    node.anchor[c] = &anchor[c];
    node.drag[c] = &drag[c];
  }
  (void)contact_forces(law, tool, found, 0.0, node, single_node);
  double normal = 0.0, tangential_square = 0.0;
  for (int c = 0; c < 3; ++c) normal += force[c] * found.normal[c][0];
  if (normal <= 0.0) return {};
  for (int c = 0; c < 3; ++c) tangential_square += std::pow(force[c] - normal * found.normal[c][0], 2);
  const bool slips = std::sqrt(tangential_square) >= law.friction * normal * (1.0 - limit_tolerance);
  return {normal, slips ? FrictionState::slip : FrictionState::stick};
}

// The same with what the node's kinks mean.
NodeContact curved_node_contact(const ContactLaw& law, const ContactTool& tool, const Distances& found,
                                const ChordTerms& terms, ContactNodes node) {
  double force[3] = {0.0, 0.0, 0.0}, anchor[3], drag[3] = {0.0, 0.0, 0.0}, lift = terms.lift[0], pressed = 0.0;
  for (int c = 0; c < 3; ++c) {
    anchor[c] = *node.anchor[c];
    node.force[c] = &force[c];
    node.anchor[c] = &anchor[c];
    node.drag[c] = &drag[c];
  }
  (void)chord_forces(law, tool, found, terms, 0.0, node, single_node, {&lift, &pressed});
  double normal = 0.0, shift2 = 0.0, q2 = 0.0, along = 0.0;
  for (int c = 0; c < 3; ++c) normal += force[c] * found.normal[c][0];
  if (normal <= 0.0) return {};
  for (int c = 0; c < 3; ++c) {
    const double a = terms.shift[c][0], q = force[c] - normal * (found.normal[c][0] + a);
    shift2 += a * a;
    q2 += q * q;
    along += q * a;
  }
  const double cosine = 1.0 / std::sqrt(1.0 + shift2), m = terms.friction[0];
  const double across = std::max(0.0, q2 - std::pow(along * cosine, 2));
  const bool slips = std::sqrt(across) - m * along * cosine >= m * normal / cosine * (1.0 - limit_tolerance);
  return {normal, slips ? FrictionState::slip : FrictionState::stick};
}

}  // namespace

ContactState Contact::contact_state(const State& state) const {
  ContactState all;
  for (const int n : packed_.packed_of_mesh) {
    int most = 0, count = 0;
    NodeContact greatest;
    double gap = std::numeric_limits<double>::max();
    for (std::size_t t = 0; t < touch_.size(); ++t) {
      const Touch& touch = touch_[t];
      const MovingTool& moving = tools_.tools()[t];
      ContactNodes node{};
      node.count = 1;
      node.mass = &mass_[n];
      node.area = &area_[n];
      double load = 0.0;
      if (sheared_ != nullptr) {
        node.swell = &sheared_->swell()[n];
        node.load = &load;
      }
      double anchor[3], drag[3] = {0.0, 0.0, 0.0};
      for (int c = 0; c < 3; ++c) {
        node.x[c] = &state.position[c][n];
        node.v[c] = &state.velocity[c][n];
        anchor[c] = touch.anchor[c][n];
        node.anchor[c] = &anchor[c];
        node.drag[c] = &drag[c];
      }
      int hint = touch.hint.empty() ? 0 : touch.hint[n];
      Distances found;
      tool_distances(moving.tool, moving.place(), {node.x[0], node.x[1], node.x[2]}, 1, &hint, found);
      ChordTerms terms;
      if (curved_) {
        ChordTurns turns;
        curved_->find_turns(state, n, 1, 1, turns);
        curved_->lift_groups(turns, state.time, n, 1, single_node, touch.law.friction, found, terms);
      }
      const double here = found.distance[0] - offset_at(touch, n);
      gap = std::min(gap, here);
      if (here >= 0.0 || mass_[n] <= 0.0) continue;
      const NodeContact contact = curved_ ? curved_node_contact(touch.law, moving.contact_tool(), found, terms, node)
                                          : node_contact(touch.law, moving.contact_tool(), found, node);
      if (contact.normal <= 0.0) continue;
      ++count;
      if (contact.normal <= greatest.normal) continue;
      greatest = contact;
      most = 1 + static_cast<int>(t);
    }
    all.tool.push_back(most);
    all.count.push_back(count);
    all.force.push_back(greatest.normal);
    all.pressure.push_back(area_[n] > 0.0 ? greatest.normal / area_[n] : 0.0);
    all.gap.push_back(gap);
    all.friction.push_back(greatest.friction);
  }
  return all;
}

}  // namespace weaveform
