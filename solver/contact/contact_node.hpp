// What the two loops over nodes at a tool have in common (contact_kernel.cpp, chord_kernel.cpp): the normal spring, the
// dampers' share of the losses, what a node keeps. Included where loops are compiled, nowhere else. All is
// written out: loops over components would keep the compiler from vectors of nodes, and so would arrays in structures.
#pragma once

#include "solver/contact/contact_kernel.hpp"

namespace weaveform {

// What the node at y in the tool's frame keeps: `stretch` of the tangential spring, and the dampers' force.
[[gnu::always_inline]] inline void keep_contact(const ContactNodes& nodes, int i, const double (&y)[3],
                                                const double (&stretch)[3], const double (&drag)[3],
                                                const double (&force)[3]) {
  nodes.anchor[0][i] = y[0] - stretch[0];
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
[[gnu::always_inline]] inline NormalSpring normal_spring(const ContactLaw& law, double offset, double inverse_softening,
                                                         double k, double c, double distance, const double (&n)[3],
                                                         const double (&v)[3]) {
  const double gap = distance - offset;
  const double p = gap < 0.0 ? -gap : 0.0;
  const double soft = p < law.softening ? p : law.softening, engaged = soft * inverse_softening;
  const double elastic = k * engaged * (p - 0.5 * soft);
  // integral of the normal force: k p^3/(6 d) to the depth d, k ((p - d/2)^2/2 + d^2/24) beyond
  const double beyond = p - soft;
  const double stored = k * (engaged * soft * soft / 6.0 + 0.5 * beyond * (soft + beyond));
  const double approach = -(v[0] * n[0] + v[1] * n[1] + v[2] * n[2]);
  const double total = elastic + c * engaged * approach;
  return {p, elastic, total > 0.0 ? total : 0.0, stored, approach};
}

// Power of the dampers' force at the step before and that of now, added up, mJ/s: along the normal what the fabric
// gets, in the surface too. `drag` goes from the one force to the other; w is the tangential speed, `cut_damping` the
// damper's coefficient as far as friction lets it act.
struct DragPower {
  double normal, tangential;
};

[[gnu::always_inline]] inline DragPower advance_drag(const NormalSpring& spring, double cut_damping,
                                                     const double (&n)[3], double w0, double w1, double w2,
                                                     double (&drag)[3]) {
  const double before = drag[0] * n[0] + drag[1] * n[1] + drag[2] * n[2], now = spring.force - spring.elastic;
  const double along0 = drag[0] - before * n[0], along1 = drag[1] - before * n[1], along2 = drag[2] - before * n[2];
  const double now0 = -cut_damping * w0, now1 = -cut_damping * w1, now2 = -cut_damping * w2;
  drag[0] = now * n[0] + now0;
  drag[1] = now * n[1] + now1;
  drag[2] = now * n[2] + now2;
  return {(before + now) * spring.approach, (along0 + now0) * w0 + (along1 + now1) * w1 + (along2 + now2) * w2};
}

}  // namespace weaveform
