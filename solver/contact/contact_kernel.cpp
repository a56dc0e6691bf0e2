// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/contact/contact_kernel.hpp"

#include <cmath>

#include "solver/contact/contact_node.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

struct Contribution {
  double force[3], area, energy, friction_work, damping_work, elastic;
};

// One node and one tool: the law of the header. `stretch` becomes what the tangential spring keeps, `drag` goes from the
// dampers' force at the step before to that of now. `offset` is the node's.
[[gnu::always_inline]] inline Contribution contact_force(const ContactLaw& law, double offset, double inverse_softening,
                                                         double mass, double area, double distance,
                                                         const double (&n)[3], const double (&d)[3],
                                                         const double (&v)[3], double time, double (&stretch)[3],
                                                         double (&drag)[3]) {
  const double k = law.frequency2 * mass, c = law.damping_rate * mass;
  const NormalSpring spring = normal_spring(law, offset, inverse_softening, k, c, distance, n, v);
  const double limit = law.friction * spring.force;

  // trial = k d + c w with the tangential parts of d and v, cut to the limit as a whole
  const double dn = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
  const double t0 = d[0] - dn * n[0], t1 = d[1] - dn * n[1], t2 = d[2] - dn * n[2];
  const double w0 = v[0] + spring.approach * n[0], w1 = v[1] + spring.approach * n[1],
               w2 = v[2] + spring.approach * n[2];
  const double s0 = k * t0 + c * w0, s1 = k * t1 + c * w1, s2 = k * t2 + c * w2;
  const double size = std::sqrt(s0 * s0 + s1 * s1 + s2 * s2);
  const double cut = size > limit ? limit / size : 1.0;
  stretch[0] = cut * t0;
  stretch[1] = cut * t1;
  stretch[2] = cut * t2;
  const double t_square = t0 * t0 + t1 * t1 + t2 * t2, t_w = t0 * w0 + t1 * w1 + t2 * w2;
  const DragPower power = advance_drag(spring, cut * c, n, w0, w1, w2, drag);

  Contribution out;
  out.force[0] = spring.force * n[0] - cut * s0;
  out.force[1] = spring.force * n[1] - cut * s1;
  out.force[2] = spring.force * n[2] - cut * s2;
  out.area = spring.depth > 0.0 ? area : 0.0;
  out.energy = spring.stored + 0.5 * k * cut * cut * t_square;
  // the spring's slip (1 - cut) t against half its force before, k (t - time w), and half of now's, k cut t
  out.friction_work = 0.5 * k * (1.0 - cut) * ((1.0 + cut) * t_square - time * t_w) - 0.5 * time * power.tangential;
  out.damping_work = 0.5 * time * power.normal;
  out.elastic = spring.elastic;
  return out;
}

template <bool swollen>
ContactSums contact_forces(const ContactLaw& law_given, const ContactTool& tool_given, const Distances& distances,
                           double time, const ContactNodes& nodes_given) {
  const ContactLaw law = law_given;
  const ContactTool tool = tool_given;
  const ContactNodes nodes = nodes_given;
  const double inverse = 1.0 / law.softening;
  double fx = 0.0, fy = 0.0, fz = 0.0, area = 0.0, energy = 0.0, friction_work = 0.0, damping_work = 0.0;
#pragma omp simd reduction(+ : fx, fy, fz, area, energy, friction_work, damping_work)
  for (int i = 0; i < nodes.count; ++i) {
    const double n[3] = {distances.normal[0][i], distances.normal[1][i], distances.normal[2][i]};
    const double y[3] = {nodes.x[0][i] - tool.origin[0], nodes.x[1][i] - tool.origin[1],
                         nodes.x[2][i] - tool.origin[2]};
    const double d[3] = {y[0] - nodes.anchor[0][i], y[1] - nodes.anchor[1][i], y[2] - nodes.anchor[2][i]};
    const double v[3] = {nodes.v[0][i] - tool.velocity[0], nodes.v[1][i] - tool.velocity[1],
                         nodes.v[2][i] - tool.velocity[2]};
    double stretch[3], drag[3] = {nodes.drag[0][i], nodes.drag[1][i], nodes.drag[2][i]};
    double offset = law.offset;
    if constexpr (swollen) offset *= nodes.swell[i];
    const Contribution c = contact_force(law, offset, inverse, nodes.mass[i], nodes.area[i], distances.distance[i], n,
                                         d, v, time, stretch, drag);
    if constexpr (swollen) nodes.load[i] += law.offset * c.elastic;
    keep_contact(nodes, i, y, stretch, drag, c.force);
    fx += c.force[0];
    fy += c.force[1];
    fz += c.force[2];
    area += c.area;
    energy += c.energy;
    friction_work += c.friction_work;
    damping_work += c.damping_work;
  }
  return {.force = {fx, fy, fz},
          .area = area,
          .energy = energy,
          .friction_work = friction_work,
          .damping_work = damping_work};
}

void reset_anchors(const ContactTool& tool, const ContactNodes& nodes) {
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < nodes.count; ++i) {
      nodes.anchor[c][i] = nodes.x[c][i] - tool.origin[c];
      nodes.drag[c][i] = 0.0;
    }
}

template <bool swollen>
double least_gap(const Distances& distances, double offset, const ContactNodes& nodes) {
  constexpr double far = 1e300;  // mm
  const double *mass = nodes.mass, *swell = nodes.swell;
  double least = far;
#pragma omp simd reduction(min : least)
  for (int i = 0; i < nodes.count; ++i) {
    double here = offset;
    if constexpr (swollen) here *= swell[i];
    const double gap = mass[i] > 0.0 ? distances.distance[i] - here : far;
    least = gap < least ? gap : least;
  }
  return least;
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
                                    .reset_anchors = reset_anchors,
                                    .least_gap = least_gap<false>,
                                    .swollen_least_gap = least_gap<true>,
                                    .greatest_speed = greatest_speed};

}  // namespace weaveform::WEAVEFORM_SET
