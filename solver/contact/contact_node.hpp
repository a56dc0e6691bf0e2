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

// The spring's stretch so far: from the anchor, where there is one.
[[gnu::always_inline]] inline void stretch_before(const ContactNodes& nodes, int i, const double (&y)[3],
                                                  double (&d)[3]) {
  const bool held = nodes.anchor[0][i] < no_anchor;
  d[0] = held ? y[0] - nodes.anchor[0][i] : 0.0;
  d[1] = held ? y[1] - nodes.anchor[1][i] : 0.0;
  d[2] = held ? y[2] - nodes.anchor[2][i] : 0.0;
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

// `inverse_softening` spares a division.
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

// Sums over nodes by the place in their group, and so the same for any width of vectors.
struct ContactLanes {
  double force[3][group_nodes], area[group_nodes], energy[group_nodes];
  double friction[group_nodes], damping[group_nodes];  // mJ, doubled; mJ/s, doubled

  [[nodiscard]] ContactSums total(double time) const {
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

}  // namespace weaveform
