// What the two loops over nodes at a tool have in common (contact_kernel.cpp, chord_kernel.cpp): the normal spring, the
// dampers' share of the losses, what a node keeps. Included where loops are compiled, nowhere else. All is
// written out: loops over components would keep the compiler from vectors of nodes, and so would arrays in structures.
#pragma once

#include "solver/contact/contact_kernel.hpp"

namespace weaveform {

// Parts along a unit normal n and within the surface; `upright` normals are (0, 0, n2), most where a binder holds a
// blank, and spare two thirds of it.
template <bool upright>
[[gnu::always_inline]] inline double along(const double (&a)[3], const double (&n)[3]) {
  if constexpr (upright) return a[2] * n[2];
  return a[0] * n[0] + a[1] * n[1] + a[2] * n[2];
}

// Of vectors that lie in the surface.
template <bool upright>
[[gnu::always_inline]] inline double product(const double (&a)[3], const double (&b)[3]) {
  if constexpr (upright) return a[0] * b[0] + a[1] * b[1];
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// a - part n.
template <bool upright>
[[gnu::always_inline]] inline void take_normal(const double (&a)[3], double part, const double (&n)[3],
                                               double (&rest)[3]) {
  rest[0] = upright ? a[0] : a[0] - part * n[0];
  rest[1] = upright ? a[1] : a[1] - part * n[1];
  rest[2] = upright ? 0.0 : a[2] - part * n[2];
}

// What the nodes of a group have in common.
struct AtTool {
  const ContactLaw& law;
  const ContactTool& tool;
  const Distances& distances;
  double inverse_softening;  // 1/mm; spares a division
  double time;               // s; of the step just made
};

// Node i, whose distance is the q-th, as the tool sees it: the tool's normal n, the place y and the speed v in the tool's
// frame, the spring's stretch d from its anchor, where it has one, and the dampers' force of the step before.
[[gnu::always_inline]] inline void see_node(const AtTool& here, const ContactNodes& nodes, int i, int q, double (&n)[3],
                                            double (&y)[3], double (&v)[3], double (&d)[3], double (&drag)[3]) {
  const bool held = nodes.anchor[0][i] < no_anchor;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    n[c] = here.distances.normal[c][q];
    y[c] = nodes.x[c][i] - here.tool.origin[c];
    v[c] = nodes.v[c][i] - here.tool.velocity[c];
    d[c] = held ? y[c] - nodes.anchor[c][i] : 0.0;
    drag[c] = nodes.drag[c][i];
  }
}

// What the node at y in the tool's frame keeps: `stretch` of the tangential spring where it touches, and the dampers'
// force.
[[gnu::always_inline]] inline void keep_contact(const ContactNodes& nodes, int i, bool touches, const double (&y)[3],
                                                const double (&stretch)[3], const double (&drag)[3],
                                                const double (&force)[3]) {
  nodes.anchor[0][i] = touches ? y[0] - stretch[0] : no_anchor;
  nodes.anchor[1][i] = y[1] - stretch[1];
  nodes.anchor[2][i] = y[2] - stretch[2];
  nodes.drag[0][i] = drag[0];
  nodes.drag[1][i] = drag[1];
  nodes.drag[2][i] = drag[2];
  nodes.force[0][i] += force[0];
  nodes.force[1][i] += force[1];
  nodes.force[2][i] += force[2];
}

// The normal law of contact_kernel.hpp; k and c are the node's.
struct NormalSpring {
  double depth;     // mm; p
  double elastic;   // N; without the damper
  double force;     // N; with it, never pulling
  double stored;    // mJ
  double approach;  // mm/s
};

template <bool upright>
[[gnu::always_inline]] inline NormalSpring normal_spring(const ContactLaw& law, double offset, double inverse_softening,
                                                         double k, double c, double distance, const double (&n)[3],
                                                         const double (&v)[3]) {
  const double gap = distance - offset;
  const double p = gap < 0.0 ? -gap : 0.0;
  const double soft = p < law.softening ? p : law.softening, engaged = soft * inverse_softening;
  const double elastic = k * engaged * (p - 0.5 * soft);
  // integral of the normal force: k p^3/(6 d) to the depth d, k ((p - d/2)^2/2 + d^2/24) beyond
  const double beyond = p - soft;
  const double stored = k * (engaged * soft * soft * (1.0 / 6.0) + 0.5 * beyond * (soft + beyond));
  const double approach = -along<upright>(v, n);
  const double total = elastic + c * engaged * approach;
  return {p, elastic, total > 0.0 ? total : 0.0, stored, approach};
}

// Power of the dampers' force at the step before and that of now, added up, mJ/s: along the normal what the fabric
// gets, in the surface too. `drag` goes from the one force to the other; w is the tangential speed, `cut_damping` the
// damper's coefficient as far as friction lets it act.
struct DragPower {
  double normal, tangential;
};

template <bool upright>
[[gnu::always_inline]] inline DragPower advance_drag(const NormalSpring& spring, double cut_damping,
                                                     const double (&n)[3], const double (&w)[3], double (&drag)[3]) {
  const double before = along<upright>(drag, n), now = spring.force - spring.elastic;
  const DragPower power = {(before + now) * spring.approach,
                           product<upright>(drag, w) - cut_damping * product<upright>(w, w)};
  drag[0] = upright ? -cut_damping * w[0] : now * n[0] - cut_damping * w[0];
  drag[1] = upright ? -cut_damping * w[1] : now * n[1] - cut_damping * w[1];
  drag[2] = upright ? now * n[2] : now * n[2] - cut_damping * w[2];
  return power;
}

// What one node adds.
struct ContactShare {
  double force[3];
  double elastic;            // N; of the normal spring
  double area, energy;       // mm^2, mJ
  double friction, damping;  // mJ, doubled; mJ/s, doubled
};

// Sums over nodes by the place in their group, and so the same for any width of vectors.
struct ContactLanes {
  double force[3][group_nodes], area[group_nodes], energy[group_nodes], friction[group_nodes], damping[group_nodes];

  [[gnu::always_inline]] void add(int lane, const ContactShare& share) {
    force[0][lane] += share.force[0];
    force[1][lane] += share.force[1];
    force[2][lane] += share.force[2];
    area[lane] += share.area;
    energy[lane] += share.energy;
    friction[lane] += share.friction;
    damping[lane] += share.damping;
  }

  [[nodiscard, gnu::always_inline]] ContactSums total(double time) const {
    ContactSums sums;
    for (int lane = 0; lane < group_nodes; ++lane) {
      for (int c = 0; c < 3; ++c) sums.force[c] += force[c][lane];
      sums.area += area[lane];
      sums.energy += energy[lane];
      sums.friction_work += 0.5 * friction[lane];
      sums.damping_work += 0.5 * time * damping[lane];
    }
    return sums;
  }
};

// Calls of(group, node, at, lanes) for each: `lanes` a constant but for a block's last nodes, so that a loop over them is
// one vector's.
template <class Of>
[[gnu::always_inline]] inline void for_groups(const ContactGroups& groups, int count, const Of& of) {
  struct Whole {
    [[gnu::always_inline]] constexpr operator int() const {
      return group_nodes;
    }  // NOLINT(google-explicit-constructor): is a number
  };
  for (int g = 0; g < groups.count; ++g) {
    const int node = groups.node[g], rest = count - node;
    if (rest < group_nodes)
      of(g, node, groups.at[g], rest);
    else
      of(g, node, groups.at[g], Whole{});
  }
}

}  // namespace weaveform
