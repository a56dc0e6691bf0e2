// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/contact/chord_kernel.hpp"

#include <cmath>

#include "solver/contact/contact_node.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

constexpr double least_square = 1e-12;  // mm^2; of a chord, where there is none
constexpr double least_kink = 1e-9;     // rad
constexpr double steepest = 0.75;       // (t.n)^2; a chord that stands on the tool is no chord of an arc

struct Kink {
  double theta;     // rad; towards the tool positive
  double shift[3];  // 1; a
};

struct Turn {
  double turn[3], mean[3];
};

[[gnu::always_inline]] inline Turn turn_of(const double (&before)[3], const double (&after)[3]) {
  const double square1 = before[0] * before[0] + before[1] * before[1] + before[2] * before[2];
  const double square2 = after[0] * after[0] + after[1] * after[1] + after[2] * after[2];
  const double inverse1 = 1.0 / std::sqrt(square1 > least_square ? square1 : least_square);
  const double inverse2 = 1.0 / std::sqrt(square2 > least_square ? square2 : least_square);
  double m[3];
  Turn result;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const double t1 = before[k] * inverse1, t2 = after[k] * inverse2;
    result.turn[k] = t2 - t1;
    m[k] = t2 + t1;
  }
  const double size = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
  const double inverse = 1.0 / std::sqrt(size > least_square ? size : least_square);
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) result.mean[k] = m[k] * inverse;
  return result;
}

// `even`: neighbours stand at constant distances.
template <bool even>
[[gnu::always_inline]] inline void turns_of(const ChordLattice& lattice_given, int family, int count,
                                            ChordTurns& turns) {
  const ChordLattice lattice = lattice_given;
  const double *x = lattice.x[0], *y = lattice.x[1], *z = lattice.x[2];
  const int *before = lattice.before[family], *after = lattice.after[family];
  const int step = family == 0 ? 1 : lattice.stride;
  double *turn0 = turns.turn[family][0] + lattice.place, *turn1 = turns.turn[family][1] + lattice.place,
         *turn2 = turns.turn[family][2] + lattice.place;
  double *mean0 = turns.mean[family][0] + lattice.place, *mean1 = turns.mean[family][1] + lattice.place,
         *mean2 = turns.mean[family][2] + lattice.place;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const int here = lattice.first + i, a = even ? here - step : before[i], b = even ? here + step : after[i];
    const double back[3] = {x[here] - x[a], y[here] - y[a], z[here] - z[a]};
    const double on[3] = {x[b] - x[here], y[b] - y[here], z[b] - z[here]};
    const Turn t = turn_of(back, on);
    turn0[i] = t.turn[0];
    turn1[i] = t.turn[1];
    turn2[i] = t.turn[2];
    mean0[i] = t.mean[0];
    mean1[i] = t.mean[1];
    mean2[i] = t.mean[2];
  }
}

void chord_turns(const ChordLattice& lattice, ChordTurns& turns) {
  for (int family = 0; family < 2; ++family)
    if (lattice.count < group_nodes)
      turns_of<false>(lattice, family, lattice.count, turns);
    else if (lattice.stride > 0)
      turns_of<true>(lattice, family, group_nodes, turns);
    else
      turns_of<false>(lattice, family, group_nodes, turns);
}

[[gnu::always_inline]] inline Kink kink(const double (&c)[3], const double (&t)[3], const double (&n)[3], bool exists) {
  const double along = t[0] * n[0] + t[1] * n[1] + t[2] * n[2];
  const double square = along * along;
  const double inverse = 1.0 / (1.0 - (square < steepest ? square : steepest));
  // -c.b = 2 sin(theta/2), b.n = sqrt(1 - (t.n)^2)
  const double u = -(c[0] * n[0] + c[1] * n[1] + c[2] * n[2]) * std::sqrt(inverse), u2 = u * u;
  Kink result;
  result.theta = exists && square < steepest ? u * (1.0 + u2 * (1.0 / 24.0 + u2 * (3.0 / 640.0))) : 0.0;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) result.shift[k] = (square * n[k] - along * t[k]) * inverse;
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
  const double square1 = warp.theta * warp.theta, square2 = weft.theta * weft.theta;
  Terms terms;
  terms.lift = (length1 * warp.theta * square1 + length2 * weft.theta * square2) /
               (24.0 * (square1 + square2 + least_kink * least_kink));
  const double towards1 = warp.theta > 0.0 ? warp.theta : 0.0, towards2 = weft.theta > 0.0 ? weft.theta : 0.0;
  const double inverse = 1.0 / (towards1 + towards2 + least_kink);
  const double share1 = towards1 * inverse, share2 = towards2 * inverse;
  terms.friction =
      share1 * belt_friction(mu, towards1) + share2 * belt_friction(mu, towards2) + (1.0 - share1 - share2) * mu;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) terms.shift[k] = share1 * warp.shift[k] + share2 * weft.shift[k];
  return terms;
}

[[gnu::always_inline]] inline void group_terms(const ChordTurns& turns, const double* warp_length,
                                               const double* weft_length, int node, int at, int lanes,
                                               const Distances& distances, double mu, ChordTerms& terms) {
#pragma omp simd
  for (int lane = 0; lane < lanes; ++lane) {
    const int i = node + lane, q = at + lane;
    const double n[3] = {distances.normal[0][q], distances.normal[1][q], distances.normal[2][q]};
    const double c1[3] = {turns.turn[0][0][i], turns.turn[0][1][i], turns.turn[0][2][i]};
    const double t1[3] = {turns.mean[0][0][i], turns.mean[0][1][i], turns.mean[0][2][i]};
    const double c2[3] = {turns.turn[1][0][i], turns.turn[1][1][i], turns.turn[1][2][i]};
    const double t2[3] = {turns.mean[1][0][i], turns.mean[1][1][i], turns.mean[1][2][i]};
    const double length1 = warp_length[i], length2 = weft_length[i];
    const Kink warp = kink(c1, t1, n, length1 > 0.0), weft = kink(c2, t2, n, length2 > 0.0);
    const Terms mean = mean_terms(warp, weft, length1, length2, mu);
    terms.lift[q] = mean.lift;
    terms.friction[q] = mean.friction;
    terms.shift[0][q] = mean.shift[0];
    terms.shift[1][q] = mean.shift[1];
    terms.shift[2][q] = mean.shift[2];
  }
}

void chord_terms(const ChordTurns& turns, const double* const (&length)[2], int count, const ContactGroups& groups,
                 const Distances& distances, double mu, ChordTerms& terms) {
  for_groups(
      groups, count, [&](int /*group*/, int node, int at, auto lanes) __attribute__((always_inline)) {
        group_terms(turns, length[0], length[1], node, at, lanes, distances, mu, terms);
      });
}

// contact_kernel.cpp's contact_force with the cone of the header: coefficient m, its centre shifted by N a.
[[gnu::always_inline]] inline ContactShare chord_force(const AtTool& here, double mass, double area, double distance,
                                                       const double (&n)[3], const double (&v)[3], double m,
                                                       const double (&a)[3], double (&d)[3], double (&drag)[3]) {
  const ContactLaw& law = here.law;
  const double time = here.time;
  const double k = law.frequency2 * mass, c = law.damping_rate * mass;
  const NormalSpring spring = normal_spring<false>(law, law.offset, here.inverse_softening, k, c, distance, n, v);
  const double normal = spring.force;

  double t[3], w[3];
  take_normal<false>(d, along<false>(d, n), n, t);
  take_normal<false>(v, -spring.approach, n, w);
  const double centre0 = normal * a[0], centre1 = normal * a[1], centre2 = normal * a[2];
  const double q0 = -(k * t[0] + c * w[0]) - centre0, q1 = -(k * t[1] + c * w[1]) - centre1,
               q2 = -(k * t[2] + c * w[2]) - centre2;
  const double a2 = a[0] * a[0] + a[1] * a[1] + a[2] * a[2], cosine2 = 1.0 / (1.0 + a2), cosine = std::sqrt(cosine2);
  const double q_a = q0 * a[0] + q1 * a[1] + q2 * a[2];
  const double across = q0 * q0 + q1 * q1 + q2 * q2 - q_a * q_a * cosine2;
  const double size = std::sqrt(across > 0.0 ? across : 0.0) - m * q_a * cosine,
               limit = m * normal * (1.0 + a2) * cosine;
  const double cut = size > limit ? limit / size : 1.0;
  const double shifted = (1.0 - cut) / (k > 0.0 ? k : 1.0);
  const double stretch[3] = {cut * t[0] - shifted * centre0, cut * t[1] - shifted * centre1,
                             cut * t[2] - shifted * centre2};
  // of the spring's forces before and now over the slip: mJ doubled, by k
  const double slip = (t[0] - time * w[0] + stretch[0]) * (t[0] - stretch[0]) +
                      (t[1] - time * w[1] + stretch[1]) * (t[1] - stretch[1]) +
                      (t[2] - time * w[2] + stretch[2]) * (t[2] - stretch[2]);
  const double kept = stretch[0] * stretch[0] + stretch[1] * stretch[1] + stretch[2] * stretch[2];
  d[0] = stretch[0];
  d[1] = stretch[1];
  d[2] = stretch[2];

  const DragPower power = advance_drag<false>(spring, cut * c, n, w, drag);
  ContactShare out;
  out.force[0] = normal * n[0] + centre0 + cut * q0;
  out.force[1] = normal * n[1] + centre1 + cut * q1;
  out.force[2] = normal * n[2] + centre2 + cut * q2;
  out.elastic = spring.elastic;
  out.area = spring.depth > 0.0 ? area : 0.0;
  out.energy = spring.stored + 0.5 * k * kept;
  out.friction = k * slip - time * power.tangential;
  out.damping = power.normal;
  return out;
}

// `lift_work`, mJ doubled, by lane.
[[gnu::always_inline]] inline void group_forces(const AtTool& here, const ChordTerms& terms, const ContactNodes& nodes,
                                                const ChordMemory& memory, int node, int at, int lanes,
                                                ContactLanes& sums, double (&lift_work)[group_nodes]) {
#pragma omp simd
  for (int lane = 0; lane < lanes; ++lane) {
    const int i = node + lane, q = at + lane;
    const double a[3] = {terms.shift[0][q], terms.shift[1][q], terms.shift[2][q]};
    const bool touched = nodes.anchor[0][i] < no_anchor;
    double n[3], y[3], v[3], d[3], drag[3];
    see_node(here, nodes, i, q, n, y, v, d, drag);
    const double distance = here.distances.distance[q], lift = terms.lift[q];
    const ContactShare share =
        chord_force(here, nodes.mass[i], nodes.area[i], distance, n, v, terms.friction[q], a, d, drag);
    lift_work[lane] += touched ? (memory.normal[i] + share.elastic) * (lift - memory.lift[i]) : 0.0;
    memory.lift[i] = lift;
    memory.normal[i] = share.elastic;
    keep_contact(nodes, i, distance < here.law.offset, y, d, drag, share.force);
    sums.add(lane, share);
  }
}

ContactSums chord_forces(const ContactLaw& law_given, const ContactTool& tool_given, const Distances& distances,
                         const ChordTerms& terms, double time, const ContactNodes& nodes_given,
                         const ContactGroups& groups, const ChordMemory& memory_given) {
  const ContactLaw law = law_given;
  const ContactTool tool = tool_given;
  const ContactNodes nodes = nodes_given;
  const ChordMemory memory = memory_given;
  const AtTool here = {law, tool, distances, 1.0 / law.softening, time};
  ContactLanes sums{};
  double lift_work[group_nodes] = {};
  for_groups(
      groups, nodes.count, [&](int /*group*/, int node, int at, auto lanes) __attribute__((always_inline)) {
        group_forces(here, terms, nodes, memory, node, at, lanes, sums, lift_work);
      });
  ContactSums total = sums.total(time);
  for (const double work : lift_work) total.damping_work -= 0.5 * work;
  return total;
}

}  // namespace

extern const ChordLoops chord_loops;
const ChordLoops chord_loops = {.chord_turns = chord_turns, .chord_terms = chord_terms, .chord_forces = chord_forces};

}  // namespace weaveform::WEAVEFORM_SET
