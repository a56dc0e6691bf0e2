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
  double theta;   // rad; towards the tool positive
  double share;   // 1; a = share off
  double off[3];  // 1; of the chords' mean direction, what lies in the tool's surface
};

struct Turn {
  double turn[3], mean[3];
};

[[gnu::always_inline]] inline Turn turn_of(const double (&before)[3], const double (&after)[3]) {
  const double square1 = before[0] * before[0] + before[1] * before[1] + before[2] * before[2];
  const double square2 = after[0] * after[0] + after[1] * after[1] + after[2] * after[2];
  const double inverse1 = 1.0 / std::sqrt(square1 > least_square ? square1 : least_square);
  const double inverse2 = 1.0 / std::sqrt(square2 > least_square ? square2 : least_square);
  Turn result;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    const double t1 = before[k] * inverse1, t2 = after[k] * inverse2;
    result.turn[k] = t2 - t1;
    result.mean[k] = 0.5 * (t2 + t1);
  }
  return result;
}

// Of `count` nodes from the packed node `first` on, into the turns' place n. `even`: neighbours stand at constant
// distances.
template <bool even>
[[gnu::always_inline]] inline void turns_of(const ChordLattice& lattice, int family, int first, int n, int count,
                                            ChordTurns& turns) {
  const double *x = lattice.x[0], *y = lattice.x[1], *z = lattice.x[2];
  const int *before = lattice.before[family], *after = lattice.after[family];
  const int step = family == 0 ? 1 : lattice.stride;
  double *turn0 = turns.turn[family][0] + n, *turn1 = turns.turn[family][1] + n, *turn2 = turns.turn[family][2] + n;
  double *mean0 = turns.mean[family][0] + n, *mean1 = turns.mean[family][1] + n, *mean2 = turns.mean[family][2] + n;
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const int here = first + i, a = even ? here - step : before[here], b = even ? here + step : after[here];
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

void chord_turns(const ChordLattice& lattice_given, int first, int count, unsigned wanted, ChordTurns& turns) {
  const ChordLattice lattice = lattice_given;
  for (int n = 0; n < count; n += group_nodes, wanted >>= 1U) {
    if ((wanted & 1U) == 0) continue;
    const int here = first + n, rest = count - n;
    const bool whole = rest >= group_nodes, even = whole && lattice.even[here / group_nodes] != 0;
    for (int family = 0; family < 2; ++family)
      if (even)
        turns_of<true>(lattice, family, here, n, group_nodes, turns);
      else
        turns_of<false>(lattice, family, here, n, whole ? group_nodes : rest, turns);
  }
}

// c is the turn, t the mean of both chords' directions, of any length.
template <bool upright>
[[gnu::always_inline]] inline Kink kink(const double (&c)[3], const double (&t)[3], const double (&n)[3], bool exists) {
  const double steep = along<upright>(t, n), square = steep * steep;
  const double whole = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
  const bool lies = square < steepest * whole;
  const double across = lies ? whole - square : 1.0, inverse = 1.0 / across;
  // -c.b = 2 sin(theta/2), b.n = sqrt(1 - (t.n)^2)
  const double u = -along<upright>(c, n) * std::sqrt(whole * inverse), u2 = u * u;
  Kink result;
  result.theta = exists && lies ? u * (1.0 + u2 * (1.0 / 24.0 + u2 * (3.0 / 640.0))) : 0.0;
  result.share = -steep * inverse;
  result.off[0] = upright ? t[0] : t[0] - steep * n[0];
  result.off[1] = upright ? t[1] : t[1] - steep * n[1];
  result.off[2] = upright ? 0.0 : t[2] - steep * n[2];
  return result;
}

struct Terms {
  double lift, friction, shift[3];
};

// The header's series of m multiplied out: m = mu - theta^2 (b[0] - theta^2 (b[1] - theta^2 b[2])).
struct Belt {
  double mu, b[3];
  explicit Belt(double friction)
      : mu(friction), b{mu * (1.0 + mu * mu) / 12.0, mu * (mu * mu / 144.0 - 1.0 / 720.0), -mu * mu * mu / 8640.0} {}
};

[[gnu::always_inline]] inline Terms mean_terms(const Kink& warp, const Kink& weft, double length1, double length2,
                                               const Belt& belt) {
  const double square1 = warp.theta * warp.theta, square2 = weft.theta * weft.theta;
  Terms terms;
  terms.lift = (length1 * warp.theta * square1 + length2 * weft.theta * square2) /
               (24.0 * (square1 + square2 + least_kink * least_kink));
  // as max(theta, 0), which g++ makes two divisions of
  const double towards1 = 0.5 * (warp.theta + std::abs(warp.theta)),
               towards2 = 0.5 * (weft.theta + std::abs(weft.theta));
  const double inverse = 1.0 / (towards1 + towards2 + least_kink);
  const double share1 = towards1 * inverse, share2 = towards2 * inverse;
  const double less1 = square1 * (belt.b[0] - square1 * (belt.b[1] - square1 * belt.b[2]));
  const double less2 = square2 * (belt.b[0] - square2 * (belt.b[1] - square2 * belt.b[2]));
  const double m = belt.mu - (share1 * less1 + share2 * less2);
  terms.friction = m > 0.0 ? m : 0.0;
  const double part1 = share1 * warp.share, part2 = share2 * weft.share;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) terms.shift[k] = part1 * warp.off[k] + part2 * weft.off[k];
  return terms;
}

template <bool upright>
[[gnu::always_inline]] inline void group_terms(const ChordTurns& turns, const double* warp_length,
                                               const double* weft_length, int node, int at, int lanes,
                                               const Belt& belt_given, double part, Distances& distances,
                                               ChordTerms& terms) {
  const Belt belt = belt_given;
#pragma omp simd
  for (int lane = 0; lane < lanes; ++lane) {
    const int i = node + lane, q = at + lane;
    const double n[3] = {distances.normal[0][q], distances.normal[1][q], distances.normal[2][q]};
    const double c1[3] = {turns.turn[0][0][i], turns.turn[0][1][i], turns.turn[0][2][i]};
    const double t1[3] = {turns.mean[0][0][i], turns.mean[0][1][i], turns.mean[0][2][i]};
    const double c2[3] = {turns.turn[1][0][i], turns.turn[1][1][i], turns.turn[1][2][i]};
    const double t2[3] = {turns.mean[1][0][i], turns.mean[1][1][i], turns.mean[1][2][i]};
    const double length1 = warp_length[i], length2 = weft_length[i];
    const Kink warp = kink<upright>(c1, t1, n, length1 > 0.0), weft = kink<upright>(c2, t2, n, length2 > 0.0);
    const Terms mean = mean_terms(warp, weft, length1, length2, belt);
    const double lift = part * mean.lift;
    terms.lift[q] = lift;
    distances.distance[q] -= lift;
    terms.friction[q] = mean.friction;
    terms.shift[0][q] = mean.shift[0];
    terms.shift[1][q] = mean.shift[1];
    terms.shift[2][q] = mean.shift[2];
  }
}

void chord_terms(const ChordTurns& turns, const double* const (&length)[2], int count, const ContactGroups& groups,
                 double friction, double part, Distances& distances, ChordTerms& terms) {
  const Belt belt(friction);
  for_groups(
      groups, count, [&](int group, int node, int at, auto lanes) __attribute__((always_inline)) {
        if (groups.upright[group])
          group_terms<true>(turns, length[0], length[1], node, at, group_nodes, belt, part, distances, terms);
        else
          group_terms<false>(turns, length[0], length[1], node, at, lanes, belt, part, distances, terms);
      });
}

// contact_kernel.cpp's contact_force with the cone of the header: coefficient m, its centre shifted by N a.
template <bool upright>
[[gnu::always_inline]] inline ContactShare chord_force(const AtTool& here, double mass, double area, double distance,
                                                       const double (&n)[3], const double (&v)[3], double m,
                                                       const double (&a)[3], double (&d)[3], double (&drag)[3]) {
  const ContactLaw& law = here.law;
  const double time = here.time;
  const double k = law.frequency2 * mass, c = law.damping_rate * mass;
  const NormalSpring spring = normal_spring<upright>(law, law.offset, here.inverse_softening, k, c, distance, n, v);
  const double normal = spring.force;

  double t[3], w[3];
  take_normal<upright>(d, along<upright>(d, n), n, t);
  take_normal<upright>(v, -spring.approach, n, w);
  const double centre[3] = {normal * a[0], normal * a[1], normal * a[2]};
  const double q[3] = {-(k * t[0] + c * w[0]) - centre[0], -(k * t[1] + c * w[1]) - centre[1],
                       -(k * t[2] + c * w[2]) - centre[2]};
  const double a2 = product<upright>(a, a), cosine2 = 1.0 / (1.0 + a2), cosine = std::sqrt(cosine2);
  const double q_a = product<upright>(q, a);
  const double across = product<upright>(q, q) - q_a * q_a * cosine2;
  const double size = std::sqrt(across > 0.0 ? across : 0.0) - m * q_a * cosine,
               limit = m * normal * (1.0 + a2) * cosine;
  const double cut = size > limit ? limit / size : 1.0;
  const double shifted = (1.0 - cut) / (k > 0.0 ? k : 1.0);
  const double stretch[3] = {cut * t[0] - shifted * centre[0], cut * t[1] - shifted * centre[1],
                             upright ? 0.0 : cut * t[2] - shifted * centre[2]};
  // of the spring's forces before and now over the slip: mJ doubled, by k
  const double forces[3] = {t[0] - time * w[0] + stretch[0], t[1] - time * w[1] + stretch[1],
                            t[2] - time * w[2] + stretch[2]};
  const double slips[3] = {t[0] - stretch[0], t[1] - stretch[1], t[2] - stretch[2]};
  const double slip = product<upright>(forces, slips), kept = product<upright>(stretch, stretch);
  d[0] = stretch[0];
  d[1] = stretch[1];
  d[2] = stretch[2];

  const DragPower power = advance_drag<upright>(spring, cut * c, n, w, drag);
  ContactShare out;
  out.force[0] = upright ? centre[0] + cut * q[0] : normal * n[0] + centre[0] + cut * q[0];
  out.force[1] = upright ? centre[1] + cut * q[1] : normal * n[1] + centre[1] + cut * q[1];
  out.force[2] = upright ? normal * n[2] : normal * n[2] + centre[2] + cut * q[2];
  out.elastic = spring.elastic;
  out.area = spring.depth > 0.0 ? area : 0.0;
  out.energy = spring.stored + 0.5 * k * kept;
  out.friction = k * slip - time * power.tangential;
  out.damping = power.normal;
  return out;
}

// `lift_work`, mJ doubled, by lane.
template <bool upright>
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
        chord_force<upright>(here, nodes.mass[i], nodes.area[i], distance, n, v, terms.friction[q], a, d, drag);
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
      groups, nodes.count, [&](int group, int node, int at, auto lanes) __attribute__((always_inline)) {
        if (groups.upright[group])
          group_forces<true>(here, terms, nodes, memory, node, at, group_nodes, sums, lift_work);
        else
          group_forces<false>(here, terms, nodes, memory, node, at, lanes, sums, lift_work);
      });
  ContactSums total = sums.total(time);
  for (const double work : lift_work) total.damping_work -= 0.5 * work;
  return total;
}

}  // namespace

extern const ChordLoops chord_loops;
const ChordLoops chord_loops = {.chord_turns = chord_turns, .chord_terms = chord_terms, .chord_forces = chord_forces};

}  // namespace weaveform::WEAVEFORM_SET
