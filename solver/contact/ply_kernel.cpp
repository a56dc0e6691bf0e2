// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
// Selections stand alone, none in another: the compiler would leave the loop scalar.
#include "solver/contact/ply_kernel.hpp"

#include <cmath>

#define WEAVEFORM_INLINE [[gnu::always_inline]] inline

namespace weaveform::WEAVEFORM_SET {
namespace {

// 1/sqrt(x) to 1e-10, x > 0: half the exponent with its sign turned, and Newton's y (3 - x y^2)/2 three times. Roots and
// divisions have a unit of their own, which a loop would wait for that left all of them to it.
WEAVEFORM_INLINE double inverse_root(double x) {
  const auto bits = __builtin_bit_cast(unsigned long, x);
  double y = __builtin_bit_cast(double, 0x5fe6eb50c7b537a9UL - (bits >> 1U));
  const double half = 0.5 * x;
  y *= 1.5 - half * y * y;
  y *= 1.5 - half * y * y;
  y *= 1.5 - half * y * y;
  return y;
}
// Keep inverses finite, far below anything that matters.
constexpr double least = 1e-30, least_area = 1e-12, least_square = 1e-60;  // mm^4, mm^2, mm^2 or N^2

// Piecewise linear, x >= 0.
WEAVEFORM_INLINE double value_at(const EvenTable& table, double x) {
  const double along = x * table.per_unit;
  const double inside = along < table.intervals ? along : table.intervals;
  long left = static_cast<long>(inside);
  left = left < table.intervals ? left : table.intervals - 1;
  const double low = table.value[left], high = table.value[left + 1];
  return low + (high - low) * (inside - static_cast<double>(left)) + table.last_slope * (along - inside);
}

// What all nodes of a block have in common.
struct Common {
  double inverse_softening, inverse_time;
  double moved;  // 1, or 0 at a first look
};

// r = dxi S_xi + deta S_eta + s n, by Cramer's rule.
// How far the foot is out of its cell, -1 where nothing acts.
WEAVEFORM_INLINE double find_foot(double twist, const PlyPassNodes& nodes, PlyFeet& feet, int i) {
  const long corner = nodes.corner[i];
  const double xi = nodes.place[0][i], eta = nodes.place[1][i];
  const double n[3] = {nodes.normals->n[0][i], nodes.normals->n[1][i], nodes.normals->n[2][i]};
  const double size = nodes.normals->size[i];
  double e1[3], e2[3], e3[3], from[3], r[3], s1[3], s2[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double* const origin = nodes.surface[c];
    const double *const first = origin + nodes.beside[0], *const second = origin + nodes.beside[1],
                        *const third = origin + nodes.beside[2];
    from[c] = nodes.x[c][i] - origin[corner];
    e1[c] = first[corner] - origin[corner];
    e2[c] = second[corner] - origin[corner];
    e3[c] = twist * (third[corner] - first[corner] - e2[c]);
    s1[c] = e1[c] + eta * e3[c];
    s2[c] = e2[c] + xi * e3[c];
    r[c] = from[c] - xi * e1[c] - eta * s2[c];
  }
  const double a[3] = {s2[1] * n[2] - s2[2] * n[1], s2[2] * n[0] - s2[0] * n[2], s2[0] * n[1] - s2[1] * n[0]};
  const double b[3] = {n[1] * s1[2] - n[2] * s1[1], n[2] * s1[0] - n[0] * s1[2], n[0] * s1[1] - n[1] * s1[0]};
  const double m[3] = {s1[1] * s2[2] - s1[2] * s2[1], s1[2] * s2[0] - s1[0] * s2[2], s1[0] * s2[1] - s1[1] * s2[0]};
  const double all = s1[0] * a[0] + s1[1] * a[1] + s1[2] * a[2];  // m.n
  const double squares = (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) * (size * size);
  const double determinant = nodes.stiffness[i] > 0.0 ? all : 0.0;
  const double held = determinant > least ? determinant : 1.0;
  // cos^2 from 1/4 to 1/2
  const double facing = 4.0 * determinant * determinant / (squares + least) - 1.0;
  const double faced = facing > 0.0 ? facing : 0.0;
  const double inverse = determinant > least ? 1.0 / held : 0.0;
  const double dxi = (r[0] * a[0] + r[1] * a[1] + r[2] * a[2]) * inverse;
  const double deta = (r[0] * b[0] + r[1] * b[1] + r[2] * b[2]) * inverse;
  const double xi_now = xi + dxi, eta_now = eta + deta;
  double square = 0.0, along = 0.0;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double second = e2[c] + xi_now * e3[c];
    const double way = from[c] - xi_now * e1[c] - eta_now * second;
    feet.s1[c][i] = e1[c] + eta_now * e3[c];
    feet.s2[c][i] = second;
    feet.r[c][i] = way;
    square += way * way;
    along += way * n[c];
  }
  nodes.place[0][i] = xi_now;
  nodes.place[1][i] = eta_now;
  feet.dxi[i] = dxi;
  feet.deta[i] = deta;
  feet.square[i] = square;
  feet.along[i] = along;
  const double meets = faced < 1.0 ? faced : 1.0;
  feet.meets[i] = determinant > least ? meets : 0.0;
  const double low = xi_now < eta_now ? xi_now : eta_now, high = xi_now > eta_now ? xi_now : eta_now;
  const double over = twist > 0.0 ? high - 1.0 : xi_now + eta_now - 1.0;
  const double out_of_cell = over > -low ? over : -low;
  const double leaves = feet.meets[i] > 0.0 ? out_of_cell : 1e300;  // so does who has no foot
  return nodes.stiffness[i] > 0.0 ? leaves : -1.0;
}

struct Normal {
  double force, elastic, stored;  // N, N, mJ
};

template <bool measured>
WEAVEFORM_INLINE Normal normal_force(const PlyPassLaw& law, const Common& common, double depth, double sinking,
                                     double k, double area) {
  const double pressed = depth > 0.0 ? depth : 0.0;
  const double soft = pressed < law.softening ? pressed : law.softening, engaged = soft * common.inverse_softening;
  const double beyond = pressed - soft;
  Normal out;
  out.elastic = k * engaged * (pressed - 0.5 * soft);
  // the integral: k p^3/(6 d) to the depth d, k ((p - d/2)^2/2 + d^2/24) beyond
  out.stored = k * (engaged * soft * soft * (1.0 / 6.0) + 0.5 * beyond * (soft + beyond));
  if constexpr (measured) {
    out.elastic = area * value_at(law.pressure, pressed);
    out.stored = area * value_at(law.pressure_energy, pressed);
  }
  const double total = out.elastic + law.damping_time * k * engaged * common.inverse_time * sinking;
  out.force = total > 0.0 ? total : 0.0;
  return out;
}

struct Contribution {
  double area, normal, friction, energy, friction_work, damping_work, depth, pressure;
};

// Where the faces are thicker than flat, and how they slope.
WEAVEFORM_INLINE void measure_reach(const PlyPassLaw& law, double twist, const PlyPassNodes& nodes, PlyFeet& feet,
                                    int i) {
  const long corner = nodes.corner[i];
  const double xi = nodes.place[0][i], eta = nodes.place[1][i];
  const double w0 = nodes.surface_swell[corner], e1 = nodes.surface_swell[corner + nodes.beside[0]] - w0,
               e2 = nodes.surface_swell[corner + nodes.beside[1]] - w0,
               e3 = twist * (nodes.surface_swell[corner + nodes.beside[2]] - w0 - e1 - e2);
  const double other = w0 + xi * e1 + eta * (e2 + xi * e3);
  feet.reach[i] = law.reach + law.half_own * (nodes.swell[i] - 1.0) + law.half_other * (other - 1.0);
  feet.rise1[i] = law.half_other * (e1 + eta * e3);
  feet.rise2[i] = law.half_other * (e2 + xi * e3);
}

template <PlyLawKind kind>
WEAVEFORM_INLINE Contribution press(const PlyPassLaw& law, const Common& common, const PlyPassNodes& nodes,
                                    PlyFeet& feet, PlyPassForces& forces, int i) {
  const double distance = std::sqrt(feet.square[i]);
  double reach = law.reach;
  if constexpr (kind.swollen) reach = feet.reach[i];
  const double depth = reach - (law.side * feet.along[i] >= 0.0 ? distance : -distance);
  // nobody gets there in one step: it is another side of a fold that the line met
  const double given = nodes.stiffness[i], there = depth < 2.0 * reach ? feet.meets[i] : 0.0;
  const double meets = given > 0.0 ? there : 0.0;
  const double k = meets * given, area = meets * law.share * nodes.area[i];
  const double kt = law.tangential * k, ct = law.damping_time * kt * common.inverse_time;
  const double sinking = depth - nodes.depth[i];  // over the step just made
  const Normal normal = normal_force<kind.measured>(law, common, depth, sinking, k, area);

  // t from the anchor to the foot, u over the step just made
  const double xi = nodes.place[0][i], eta = nodes.place[1][i], dxi = feet.dxi[i], deta = feet.deta[i];
  const double t1 = xi - nodes.anchor[0][i], t2 = eta - nodes.anchor[1][i];
  const double q1 = kt * t1 + ct * dxi, q2 = kt * t2 + ct * deta;
  const double drag0 = nodes.drag[0][i], drag1 = nodes.drag[1][i], drag2 = nodes.drag[2][i];
  double g11 = 0.0, g12 = 0.0, g22 = 0.0;  // the metric of the cell: products of its vectors' components
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    g11 += feet.s1[d][i] * feet.s1[d][i];
    g12 += feet.s1[d][i] * feet.s2[d][i];
    g22 += feet.s2[d][i] * feet.s2[d][i];
  }
  const double u_1 = g11 * dxi + g12 * deta, u_2 = g12 * dxi + g22 * deta;
  const double u_square = dxi * u_1 + deta * u_2, t_u = t1 * u_1 + t2 * u_2, u_drag = drag1 * u_1 + drag2 * u_2;
  const double t_square = t1 * (g11 * t1 + g12 * t2) + t2 * (g12 * t1 + g22 * t2);
  const double s_square = q1 * (g11 * q1 + g12 * q2) + q2 * (g12 * q1 + g22 * q2);
  const double t_size = t_square * inverse_root(t_square + least_square);
  const double s_inverse = inverse_root(s_square + least_square), s_size = s_square * s_inverse;
  double limit = law.friction * normal.force, holds = depth > 0.0 ? 1.0 : 0.0;
  if constexpr (kind.sheared) {
    holds = depth > law.adhesion ? 1.0 : 0.0;
    limit += holds * area * value_at(law.shear, nodes.path[i] + t_size);
  }
  const double held = s_size > limit ? limit * s_inverse : 1.0;
  const double cut = k > 0.0 ? held : 0.0;  // without a foot nothing is stretched
  feet.normal[i] = law.side * normal.force;
  feet.q1[i] = -cut * q1;
  feet.q2[i] = -cut * q2;
  if constexpr (kind.swollen) {
    const double area_square = g11 * g22 - g12 * g12, slope = normal.force / (area_square + least);
    feet.q1[i] -= slope * (g22 * feet.rise1[i] - g12 * feet.rise2[i]);
    feet.q2[i] -= slope * (g11 * feet.rise2[i] - g12 * feet.rise1[i]);
  }
  forces.acts[i] = normal.force + cut * s_size;

  // a node on which nothing acts keeps what it had
  const double drag_now = normal.force - normal.elastic, slid = (1.0 - cut) * t_size * holds;
  nodes.anchor[0][i] = given > 0.0 ? xi - cut * t1 : nodes.anchor[0][i];
  nodes.anchor[1][i] = given > 0.0 ? eta - cut * t2 : nodes.anchor[1][i];
  nodes.path[i] += given > 0.0 ? slid : 0.0;
  nodes.depth[i] = given > 0.0 ? depth : nodes.depth[i];
  nodes.drag[0][i] = given > 0.0 ? drag_now : drag0;
  nodes.drag[1][i] = given > 0.0 ? -cut * ct * dxi : drag1;
  nodes.drag[2][i] = given > 0.0 ? -cut * ct * deta : drag2;

  Contribution out;
  out.area = depth > 0.0 ? area : 0.0;
  out.normal = normal.force;
  out.friction = cut * s_size;
  out.energy = normal.stored + 0.5 * kt * cut * cut * t_square;
  // the spring's slip (1 - cut) t against half its force before, k_t (t - u), and half of now's, k_t cut t
  const double counted = given > 0.0 ? common.moved : 0.0;  // who has drag from a triangle is counted there
  out.friction_work =
      counted * 0.5 * (kt * (1.0 - cut) * ((1.0 + cut) * t_square - t_u) - (u_drag - cut * ct * u_square));
  out.damping_work = common.moved * meets * 0.5 * (drag0 + drag_now) * sinking;
  out.depth = k > 0.0 ? depth : -1e300;
  out.pressure = normal.force / (area + least_area);
  return out;
}

// F, what the corners take of it, and the couple on the node's neighbours.
template <bool swollen>
WEAVEFORM_INLINE void share_out(const PlyPassLaw& law, double twist, const PlyPassNodes& nodes, const PlyFeet& feet,
                                PlyPull& pull, PlyPassForces& forces, int i) {
  const double xi = nodes.place[0][i], eta = nodes.place[1][i], q1 = feet.q1[i], q2 = feet.q2[i];
  const double n3 = twist * xi * eta;
  const double n[3] = {nodes.normals->n[0][i], nodes.normals->n[1][i], nodes.normals->n[2][i]};
  const double r[3] = {feet.r[0][i], feet.r[1][i], feet.r[2][i]};
  const double s1[3] = {feet.s1[0][i], feet.s1[1][i], feet.s1[2][i]},
               s2[3] = {feet.s2[0][i], feet.s2[1][i], feet.s2[2][i]};
  const double m[3] = {s1[1] * s2[2] - s1[2] * s2[1], s1[2] * s2[0] - s1[0] * s2[2], s1[0] * s2[1] - s1[1] * s2[0]};
  const double m_n = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
  double t[3], f[3], t_n = 0.0;
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    t[d] = q1 * s1[d] + q2 * s2[d];
    t_n += t[d] * n[d];
  }
  const double met = m_n > least ? m_n : 1.0;  // where there is no foot there is no force
  const double along = (feet.normal[i] * nodes.normals->size[i] - t_n) / met;
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    f[d] = along * m[d] + t[d];
    pull.force[d][i] += f[d];
    forces.force[4 * i + d] = f[d];
  }
  pull.couple[0][i] += r[2] * f[1] - r[1] * f[2];
  pull.couple[1][i] += r[0] * f[2] - r[2] * f[0];
  pull.couple[2][i] += r[1] * f[0] - r[0] * f[1];
  double on_other = 0.0;
  if constexpr (swollen) {
    const double normal = law.side * feet.normal[i];
    pull.load[i] += normal * law.half_own;
    on_other = -normal * law.half_other;
  }
  forces.force[4 * i + 3] = on_other;
  forces.weight[0][i] = 1.0 - xi - eta + n3;
  forces.weight[1][i] = xi - n3;
  forces.weight[2][i] = eta - n3;
  forces.weight[3][i] = n3;
}

double find_feet(const PlyPassNodes& nodes_given, PlyFeet& feet, int first, int end) {
  const PlyPassNodes nodes = nodes_given;
  const double twist = nodes.beside[2] != 0 ? 1.0 : 0.0;  // none of a triangle
  double outside = -1.0;
#pragma omp simd reduction(max : outside)
  for (int i = first; i < end; ++i) {
    const double one = find_foot(twist, nodes, feet, i);
    outside = one > outside ? one : outside;
  }
  return outside;
}

template <PlyLawKind kind>
PlyPassSums press_all(const PlyPassLaw& law_given, double inverse_time, const PlyPassNodes& nodes_given, PlyFeet& feet,
                      PlyPassForces& forces, int first, int end) {
  const PlyPassLaw law = law_given;
  const PlyPassNodes nodes = nodes_given;
  const Common common = {
      .inverse_softening = 1.0 / law.softening, .inverse_time = inverse_time, .moved = inverse_time > 0.0 ? 1.0 : 0.0};
  if constexpr (kind.swollen) {
    const double twist = nodes.beside[2] != 0 ? 1.0 : 0.0;
#pragma omp simd
    for (int i = first; i < end; ++i) measure_reach(law, twist, nodes, feet, i);
  }
  double area = 0.0, normal = 0.0, friction = 0.0, energy = 0.0, friction_work = 0.0, damping_work = 0.0;
  double depth = -1e300, pressure = 0.0;
#pragma omp simd reduction(+ : area, normal, friction, energy, friction_work, damping_work) \
    reduction(max : depth, pressure)
  for (int i = first; i < end; ++i) {
    const Contribution one = press<kind>(law, common, nodes, feet, forces, i);
    area += one.area;
    normal += one.normal;
    friction += one.friction;
    energy += one.energy;
    friction_work += one.friction_work;
    damping_work += one.damping_work;
    depth = one.depth > depth ? one.depth : depth;
    pressure = one.pressure > pressure ? one.pressure : pressure;
  }
  return {.area = area,
          .normal = normal,
          .friction = friction,
          .energy = energy,
          .friction_work = friction_work,
          .damping_work = damping_work,
          .depth = depth,
          .pressure = pressure};
}

template <bool swollen>
void share_all(const PlyPassLaw& law_given, const PlyPassNodes& nodes_given, const PlyFeet& feet, PlyPull& pull,
               PlyPassForces& forces, int first, int end) {
  const PlyPassLaw law = law_given;
  const PlyPassNodes nodes = nodes_given;
  const double twist = nodes.beside[2] != 0 ? 1.0 : 0.0;
#pragma omp simd
  for (int i = first; i < end; ++i) share_out<swollen>(law, twist, nodes, feet, pull, forces, i);
}

void add(int count, const double* more, double* into) {
#pragma omp simd
  for (int i = 0; i < count; ++i) into[i] += more[i];
}

void ways(int lanes, int stride, const double* const (&x)[3], PlyNormals& normals) {
  const double *x0 = x[0], *x1 = x[1], *x2 = x[2];
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    normals.a[0][i] = x0[i + 1] - x0[i - 1];
    normals.a[1][i] = x1[i + 1] - x1[i - 1];
    normals.a[2][i] = x2[i + 1] - x2[i - 1];
    normals.b[0][i] = x0[i + stride] - x0[i - stride];
    normals.b[1][i] = x1[i + stride] - x1[i - stride];
    normals.b[2][i] = x2[i + stride] - x2[i - stride];
  }
}

void turn(int lanes, PlyNormals& normals) {
#pragma omp simd
  for (int i = 0; i < lanes; ++i) {
    const double a[3] = {normals.a[0][i], normals.a[1][i], normals.a[2][i]},
                 b[3] = {normals.b[0][i], normals.b[1][i], normals.b[2][i]};
    const double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    normals.n[0][i] = n[0];
    normals.n[1][i] = n[1];
    normals.n[2][i] = n[2];
    normals.size[i] = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
}

// a x G_a + b x G_b = C: what is across n by f = C x n/n^2, the rest, of rounding's size, by turning both.
void take(int count, const PlyNormals& normals, const PlyPull& pull, double* const (&force)[3],
          double* const (&lever)[6]) {
  double *f0 = force[0], *f1 = force[1], *f2 = force[2];
  double *a0 = lever[0], *a1 = lever[1], *a2 = lever[2], *b0 = lever[3], *b1 = lever[4], *b2 = lever[5];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double a[3] = {normals.a[0][i], normals.a[1][i], normals.a[2][i]},
                 b[3] = {normals.b[0][i], normals.b[1][i], normals.b[2][i]},
                 n[3] = {normals.n[0][i], normals.n[1][i], normals.n[2][i]},
                 c[3] = {pull.couple[0][i], pull.couple[1][i], pull.couple[2][i]};
    const double n_n = normals.size[i] * normals.size[i] + least;
    const double a_b = a[0] * a[0] + a[1] * a[1] + a[2] * a[2] + b[0] * b[0] + b[1] * b[1] + b[2] * b[2] + least;
    const double inverse = 1.0 / n_n;
    const double g[3] = {(c[1] * n[2] - c[2] * n[1]) * inverse, (c[2] * n[0] - c[0] * n[2]) * inverse,
                         (c[0] * n[1] - c[1] * n[0]) * inverse};
    const double w = (c[0] * n[0] + c[1] * n[1] + c[2] * n[2]) * inverse / a_b;
    f0[i] += pull.force[0][i];
    f1[i] += pull.force[1][i];
    f2[i] += pull.force[2][i];
    a0[i] = b[1] * g[2] - b[2] * g[1] + w * (n[1] * a[2] - n[2] * a[1]);
    a1[i] = b[2] * g[0] - b[0] * g[2] + w * (n[2] * a[0] - n[0] * a[2]);
    a2[i] = b[0] * g[1] - b[1] * g[0] + w * (n[0] * a[1] - n[1] * a[0]);
    b0[i] = g[1] * a[2] - g[2] * a[1] + w * (n[1] * b[2] - n[2] * b[1]);
    b1[i] = g[2] * a[0] - g[0] * a[2] + w * (n[2] * b[0] - n[0] * b[2]);
    b2[i] = g[0] * a[1] - g[1] * a[0] + w * (n[0] * b[1] - n[1] * b[0]);
  }
}

void lever(int count, int stride, const double* const (&given)[6], double* const (&force)[3]) {
  for (int d = 0; d < 3; ++d) {
    const double *west = given[d] - 1, *east = given[d] + 1, *south = given[d + 3] - stride,
                 *north = given[d + 3] + stride;
    double* const into = force[d];
#pragma omp simd
    for (int i = 0; i < count; ++i) into[i] += (west[i] - east[i]) + (south[i] - north[i]);
  }
}

using Four [[gnu::vector_size(32)]] = double;

void give_back(int first, int end, const long* corner, const int (&beside)[3], const PlyPassForces& forces,
               double* into, char* touched) {
  const int away[4] = {0, beside[0], beside[1], beside[2]};
  for (int i = first; i < end; ++i) {
    if (!(forces.acts[i] > 0.0)) continue;
    const Four force = *reinterpret_cast<const Four*>(forces.force + 4 * static_cast<long>(i));
    for (int a = 0; a < 4; ++a) {
      const long node = corner[i] + away[a];
      *reinterpret_cast<Four*>(into + 4 * node) -= forces.weight[a][i] * force;
      touched[node / ply_segment] = 1;
    }
  }
}

void fold_loads(int count, const double* from, double* into) {
#pragma omp simd
  for (int i = 0; i < count; ++i) into[i] += from[4 * i + 3];
}

void fold(int count, double* from, double* const (&into)[3]) {
  double *x = into[0], *y = into[1], *z = into[2];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    x[i] += from[4 * i];
    y[i] += from[4 * i + 1];
    z[i] += from[4 * i + 2];
  }
  for (int i = 0; i < 4 * count; ++i) from[i] = 0.0;
}

double speed(int count, const double* const (&v)[3]) {
  const double *vx = v[0], *vy = v[1], *vz = v[2];
  double greatest = 0.0;
#pragma omp simd reduction(max : greatest)
  for (int i = 0; i < count; ++i) {
    const double square = vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i];
    greatest = square > greatest ? square : greatest;
  }
  return std::sqrt(greatest);
}

}  // namespace

extern const PlyLoops ply_loops;
const PlyLoops ply_loops = {
    .feet = find_feet,
    .press = {press_all<PlyLawKind::of(0)>, press_all<PlyLawKind::of(1)>, press_all<PlyLawKind::of(2)>,
              press_all<PlyLawKind::of(3)>, press_all<PlyLawKind::of(4)>, press_all<PlyLawKind::of(5)>,
              press_all<PlyLawKind::of(6)>, press_all<PlyLawKind::of(7)>},
    .share = share_all<false>,
    .share_swollen = share_all<true>,
    .add = add,
    .ways = ways,
    .turn = turn,
    .take = take,
    .lever = lever,
    .give_back = give_back,
    .fold_loads = fold_loads,
    .fold = fold,
    .speed = speed};

}  // namespace weaveform::WEAVEFORM_SET
