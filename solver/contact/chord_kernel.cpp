// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/contact/chord_kernel.hpp"

#include <cmath>

namespace weaveform::WEAVEFORM_SET {
namespace {

constexpr double least_square = 1e-12;  // mm^2; of a chord, where there is none
constexpr double least_kink = 1e-9;     // rad
constexpr double steepest = 0.75;       // (t.n)^2; a chord that stands on the tool is no chord of an arc
constexpr double no_lift = 1e29;        // mm

struct Kink {
  double theta;     // rad; towards the tool positive
  double shift[3];  // 1; a
};

// Of one yarn at one node with the chords before and after.
[[gnu::always_inline]] inline Kink kink(const double (&before)[3], const double (&after)[3], const double (&n)[3],
                                        bool exists) {
  const double square1 = before[0] * before[0] + before[1] * before[1] + before[2] * before[2];
  const double square2 = after[0] * after[0] + after[1] * after[1] + after[2] * after[2];
  const double inverse1 = 1.0 / std::sqrt(square1 > least_square ? square1 : least_square);
  const double inverse2 = 1.0 / std::sqrt(square2 > least_square ? square2 : least_square);
  double c[3], m[3];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const double t1 = before[k] * inverse1, t2 = after[k] * inverse2;
    c[k] = t2 - t1;
    m[k] = t2 + t1;
  }
  const double size = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
  const double inverse = 1.0 / std::sqrt(size > least_square ? size : least_square);
  const double along = (m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) * inverse;  // t.n
  const double square = along * along, flat = 1.0 - (square < steepest ? square : steepest);
  const bool counts = exists && square < steepest;
  // -c.b = 2 sin(theta/2), b.n = sqrt(1 - (t.n)^2)
  const double u = -(c[0] * n[0] + c[1] * n[1] + c[2] * n[2]) / std::sqrt(flat), u2 = u * u;
  Kink result;
  result.theta = counts ? u * (1.0 + u2 * (1.0 / 24.0 + u2 * (3.0 / 640.0))) : 0.0;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) result.shift[k] = (square * n[k] - along * m[k] * inverse) / flat;
  return result;
}

// m of the header
[[gnu::always_inline]] inline double belt_friction(double mu, double theta) {
  const double square = theta * theta;
  const double m =
      mu * (1.0 - square * (1.0 / 12.0 + square * (1.0 / 720.0))) * (1.0 - mu * mu * square * (1.0 / 12.0));
  return m > 0.0 ? m : 0.0;
}

struct Terms {
  double lift, friction, shift[3];
};

[[gnu::always_inline]] inline Terms mean_terms(const Kink& warp, const Kink& weft, double length1, double length2,
                                               double mu) {
  const double size1 = std::abs(warp.theta), size2 = std::abs(weft.theta);
  Terms terms;
  terms.lift = (length1 * warp.theta * size1 + length2 * weft.theta * size2) / (24.0 * (size1 + size2 + least_kink));
  const double towards1 = warp.theta > 0.0 ? warp.theta : 0.0, towards2 = weft.theta > 0.0 ? weft.theta : 0.0;
  const double inverse = 1.0 / (towards1 + towards2 + least_kink);
  const double share1 = towards1 * inverse, share2 = towards2 * inverse;
  terms.friction =
      share1 * belt_friction(mu, towards1) + share2 * belt_friction(mu, towards2) + (1.0 - share1 - share2) * mu;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) terms.shift[k] = share1 * warp.shift[k] + share2 * weft.shift[k];
  return terms;
}

void chord_terms(const ChordLattice& lattice_given, const Distances& distances, double mu, ChordTerms& terms) {
  const ChordLattice lattice = lattice_given;
  const double *x = lattice.x[0], *y = lattice.x[1], *z = lattice.x[2];
#pragma omp simd
  for (int i = 0; i < lattice.count; ++i) {
    const double n[3] = {distances.normal[0][i], distances.normal[1][i], distances.normal[2][i]};
    const int here = lattice.first + i;
    const int a1 = lattice.before[0][i], b1 = lattice.after[0][i], a2 = lattice.before[1][i], b2 = lattice.after[1][i];
    const double before1[3] = {x[here] - x[a1], y[here] - y[a1], z[here] - z[a1]};
    const double after1[3] = {x[b1] - x[here], y[b1] - y[here], z[b1] - z[here]};
    const double before2[3] = {x[here] - x[a2], y[here] - y[a2], z[here] - z[a2]};
    const double after2[3] = {x[b2] - x[here], y[b2] - y[here], z[b2] - z[here]};
    const double length1 = lattice.length[0][i], length2 = lattice.length[1][i];
    const Kink warp = kink(before1, after1, n, length1 > 0.0), weft = kink(before2, after2, n, length2 > 0.0);
    const Terms mean = mean_terms(warp, weft, length1, length2, mu);
    terms.lift[i] = mean.lift;
    terms.friction[i] = mean.friction;
    terms.shift[0][i] = mean.shift[0];
    terms.shift[1][i] = mean.shift[1];
    terms.shift[2][i] = mean.shift[2];
  }
}

struct Contribution {
  double force[3], normal, area, energy, friction_work, damping_work;
};

// contact_kernel.cpp's contact_force with the cone of the header: coefficient m, its centre shifted by N a.
[[gnu::always_inline]] inline Contribution chord_force(const ContactLaw& law, double inverse_softening, double mass,
                                                       double area, double distance, const double (&n)[3],
                                                       const double (&d)[3], const double (&v)[3], double m,
                                                       const double (&a)[3], double time, double (&stretch)[3],
                                                       double (&drag)[3]) {
  const double k = law.frequency2 * mass, c = law.damping_rate * mass;
  const double gap = distance - law.offset;
  const double p = gap < 0.0 ? -gap : 0.0;
  const double soft = p < law.softening ? p : law.softening, engaged = soft * inverse_softening;
  const double elastic = k * engaged * (p - 0.5 * soft);
  const double beyond = p - soft;
  const double stored_normal = k * (engaged * soft * soft / 6.0 + 0.5 * beyond * (soft + beyond));
  const double approach = -(v[0] * n[0] + v[1] * n[1] + v[2] * n[2]);
  const double total = elastic + c * engaged * approach;
  const double normal = total > 0.0 ? total : 0.0;

  const double dn = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
  double t[3], w[3], centre[3], q[3];
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    t[j] = d[j] - dn * n[j];
    w[j] = v[j] + approach * n[j];
    centre[j] = normal * a[j];
    q[j] = -(k * t[j] + c * w[j]) - centre[j];
  }
  const double cosine2 = 1.0 / (1.0 + a[0] * a[0] + a[1] * a[1] + a[2] * a[2]), cosine = std::sqrt(cosine2);
  const double q_a = q[0] * a[0] + q[1] * a[1] + q[2] * a[2];
  const double across = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] - q_a * q_a * cosine2;
  const double size = std::sqrt(across > 0.0 ? across : 0.0) - m * q_a * cosine, limit = m * normal / cosine;
  const double cut = size > limit ? limit / size : 1.0;
  const double inverse_k = k > 0.0 ? 1.0 / k : 0.0;

  double slip_force = 0.0;  // of the spring's two forces, over the slip: mJ doubled
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    stretch[j] = cut * t[j] - (1.0 - cut) * centre[j] * inverse_k;
    slip_force += (t[j] - time * w[j] + stretch[j]) * (t[j] - stretch[j]);
  }
  const double kept = stretch[0] * stretch[0] + stretch[1] * stretch[1] + stretch[2] * stretch[2];

  const double drag_before = drag[0] * n[0] + drag[1] * n[1] + drag[2] * n[2], drag_now = normal - elastic;
  Contribution out;
  double drag_power = 0.0;
#pragma GCC unroll 3
  for (int j = 0; j < 3; ++j) {
    const double along = drag[j] - drag_before * n[j], now = -cut * c * w[j];
    drag_power += (along + now) * w[j];
    drag[j] = drag_now * n[j] + now;
    out.force[j] = normal * n[j] + centre[j] + cut * q[j];
  }
  out.normal = elastic;
  out.area = p > 0.0 ? area : 0.0;
  out.energy = stored_normal + 0.5 * k * kept;
  out.friction_work = 0.5 * k * slip_force - 0.5 * time * drag_power;
  out.damping_work = 0.5 * time * (drag_before + drag_now) * approach;
  return out;
}

ContactSums chord_forces(const ContactLaw& law_given, const ContactTool& tool_given, const Distances& distances,
                         const ChordTerms& terms, double time, const ContactNodes& nodes_given,
                         const ChordMemory& memory_given) {
  const ContactLaw law = law_given;
  const ContactTool tool = tool_given;
  const ContactNodes nodes = nodes_given;
  const ChordMemory memory = memory_given;
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
    const double a[3] = {terms.shift[0][i], terms.shift[1][i], terms.shift[2][i]};
    double stretch[3], drag[3] = {nodes.drag[0][i], nodes.drag[1][i], nodes.drag[2][i]};
    const Contribution c = chord_force(law, inverse, nodes.mass[i], nodes.area[i], distances.distance[i], n, d, v,
                                       terms.friction[i], a, time, stretch, drag);
    const double lift_before = memory.lift[i], lifted = lift_before < no_lift ? terms.lift[i] - lift_before : 0.0;
    const double lift_work = 0.5 * (memory.normal[i] + c.normal) * lifted;
    memory.lift[i] = terms.lift[i];
    memory.normal[i] = c.normal;
    nodes.anchor[0][i] = y[0] - stretch[0];
    nodes.anchor[1][i] = y[1] - stretch[1];
    nodes.anchor[2][i] = y[2] - stretch[2];
    nodes.drag[0][i] = drag[0];
    nodes.drag[1][i] = drag[1];
    nodes.drag[2][i] = drag[2];
    nodes.force[0][i] += c.force[0];
    nodes.force[1][i] += c.force[1];
    nodes.force[2][i] += c.force[2];
    fx += c.force[0];
    fy += c.force[1];
    fz += c.force[2];
    area += c.area;
    energy += c.energy;
    friction_work += c.friction_work;
    damping_work += c.damping_work - lift_work;
  }
  return {.force = {fx, fy, fz},
          .area = area,
          .energy = energy,
          .friction_work = friction_work,
          .damping_work = damping_work};
}

}  // namespace

extern const ChordLoops chord_loops;
const ChordLoops chord_loops = {.chord_terms = chord_terms, .chord_forces = chord_forces};

}  // namespace weaveform::WEAVEFORM_SET
