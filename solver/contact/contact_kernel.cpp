// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/contact/contact_kernel.hpp"

#include <cmath>

#include "solver/contact/contact_node.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

// One node and one tool: the law of the header. `d` becomes what the tangential spring keeps, `drag` goes from the
// dampers' force at the step before to that of now. `offset` is the node's.
template <bool upright>
[[gnu::always_inline]] inline ContactShare contact_force(const AtTool& here, double offset, double mass, double area,
                                                         double distance, const double (&n)[3], const double (&v)[3],
                                                         double (&d)[3], double (&drag)[3]) {
  const ContactLaw& law = here.law;
  const double time = here.time;
  const double k = law.frequency2 * mass, c = law.damping_rate * mass;
  const NormalSpring spring = normal_spring<upright>(law, offset, here.inverse_softening, k, c, distance, n, v);
  const double limit = law.friction * spring.force;

  // trial = k t + c w with the tangential parts of d and v, cut to the limit as a whole
  double t[3], w[3];
  take_normal<upright>(d, along<upright>(d, n), n, t);
  take_normal<upright>(v, -spring.approach, n, w);
  const double s[3] = {k * t[0] + c * w[0], k * t[1] + c * w[1], upright ? 0.0 : k * t[2] + c * w[2]};
  const double size = std::sqrt(product<upright>(s, s));
  const double cut = size > limit ? limit / size : 1.0;
  const double t_square = product<upright>(t, t), t_w = product<upright>(t, w);
  const DragPower power = advance_drag<upright>(spring, cut * c, n, w, drag);
  d[0] = cut * t[0];
  d[1] = cut * t[1];
  d[2] = upright ? 0.0 : cut * t[2];

  ContactShare out;
  out.force[0] = upright ? -cut * s[0] : spring.force * n[0] - cut * s[0];
  out.force[1] = upright ? -cut * s[1] : spring.force * n[1] - cut * s[1];
  out.force[2] = upright ? spring.force * n[2] : spring.force * n[2] - cut * s[2];
  out.area = spring.depth > 0.0 ? area : 0.0;
  out.energy = spring.stored + 0.5 * k * cut * cut * t_square;
  // the spring's slip (1 - cut) t against half its force before, k (t - time w), and half of now's, k cut t
  out.friction = k * (1.0 - cut) * ((1.0 + cut) * t_square - time * t_w) - time * power.tangential;
  out.damping = power.normal;
  out.elastic = spring.elastic;
  return out;
}

template <bool swollen, bool upright>
[[gnu::always_inline]] inline void group_forces(const AtTool& here, const ContactNodes& nodes, int node, int at,
                                                int lanes, ContactLanes& sums) {
#pragma omp simd
  for (int lane = 0; lane < lanes; ++lane) {
    const int i = node + lane, q = at + lane;
    double n[3], y[3], v[3], d[3], drag[3], offset = here.law.offset;
    see_node(here, nodes, i, q, n, y, v, d, drag);
    if constexpr (swollen) offset *= nodes.swell[i];
    const double distance = here.distances.distance[q];
    const ContactShare share =
        contact_force<upright>(here, offset, nodes.mass[i], nodes.area[i], distance, n, v, d, drag);
    if constexpr (swollen) nodes.load[i] += here.law.offset * share.elastic;
    keep_contact(nodes, i, distance < offset, y, d, drag, share.force);
    sums.add(lane, share);
  }
}

template <bool swollen>
ContactSums contact_forces(const ContactLaw& law_given, const ContactTool& tool_given, const Distances& distances,
                           double time, const ContactNodes& nodes_given, const ContactGroups& groups) {
  const ContactLaw law = law_given;
  const ContactTool tool = tool_given;
  const ContactNodes nodes = nodes_given;
  const AtTool here = {law, tool, distances, 1.0 / law.softening, time};
  ContactLanes sums{};
  for_groups(
      groups, nodes.count, [&](int group, int node, int at, auto lanes) __attribute__((always_inline)) {
        if (groups.upright[group])
          group_forces<swollen, true>(here, nodes, node, at, lanes, sums);
        else
          group_forces<swollen, false>(here, nodes, node, at, lanes, sums);
      });
  return sums.total(time);
}

template <bool swollen>
[[gnu::always_inline]] inline double group_gap(const double* distance, double offset, const double* mass,
                                               const double* swell, int lanes) {
  constexpr double far = 1e300;  // mm
  double least = far;
#pragma omp simd reduction(min : least)
  for (int lane = 0; lane < lanes; ++lane) {
    double here = offset;
    if constexpr (swollen) here *= swell[lane];
    const double gap = mass[lane] > 0.0 ? distance[lane] - here : far;
    least = gap < least ? gap : least;
  }
  return least;
}

template <bool swollen>
void least_gaps(const Distances& distances, double offset, const ContactNodes& nodes, const ContactGroups& groups,
                double (&gaps)[groups_in_block]) {
  for_groups(
      groups, nodes.count, [&](int group, int node, int at, auto lanes) __attribute__((always_inline)) {
        gaps[group] = group_gap<swollen>(distances.distance + at, offset, nodes.mass + node,
                                         swollen ? nodes.swell + node : nullptr, lanes);
      });
}

void find_upright(const Distances& distances, int count, ContactGroups& groups) {
  for (int g = 0; g < groups.count; ++g) {
    const double *x = distances.normal[0] + groups.at[g], *y = distances.normal[1] + groups.at[g];
    unsigned long aside = 0;
#pragma omp simd reduction(| : aside)
    for (int lane = 0; lane < group_nodes; ++lane)
      aside |= __builtin_bit_cast(unsigned long, x[lane]) | __builtin_bit_cast(unsigned long, y[lane]);
    groups.upright[g] = aside << 1U == 0 && count - groups.node[g] >= group_nodes;  // -0 has a sign
  }
}

double greatest_speed(const std::array<double, 3>& reference, const ContactNodes& nodes) {
  const double rx = reference[0], ry = reference[1], rz = reference[2];
  const double *mass = nodes.mass, *vx = nodes.v[0], *vy = nodes.v[1], *vz = nodes.v[2];
  double greatest = 0.0;
#pragma omp simd reduction(max : greatest)
  for (int i = 0; i < nodes.count; ++i) {
    const double x = vx[i] - rx, y = vy[i] - ry, z = vz[i] - rz;
    const double square = mass[i] > 0.0 ? x * x + y * y + z * z : 0.0;
    greatest = square > greatest ? square : greatest;
  }
  return std::sqrt(greatest);
}

}  // namespace

extern const ContactLoops contact_loops;
const ContactLoops contact_loops = {.contact_forces = contact_forces<false>,
                                    .swollen_contact_forces = contact_forces<true>,
                                    .least_gaps = least_gaps<false>,
                                    .swollen_least_gaps = least_gaps<true>,
                                    .find_upright = find_upright,
                                    .greatest_speed = greatest_speed};

}  // namespace weaveform::WEAVEFORM_SET
