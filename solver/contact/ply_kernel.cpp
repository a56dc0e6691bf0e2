// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
// Selections stand alone, none in another: the compiler would leave the loop scalar.
#include "solver/contact/ply_kernel.hpp"

#include <cmath>

#define WEAVEFORM_INLINE [[gnu::always_inline]] inline

namespace weaveform::WEAVEFORM_SET {
namespace {

// 1/sqrt(x) to 1e-10, x > 0: half the exponent with its sign turned, and Newton's y (3 - x y^2)/2 three times. A loop
// of roots and divisions would wait for those alone. Where more is needed one more step makes it so.
WEAVEFORM_INLINE double inverse_root(double x) {
  const auto bits = __builtin_bit_cast(unsigned long, x);
  double y = __builtin_bit_cast(double, 0x5fe6eb50c7b537a9UL - (bits >> 1U));
  const double half = 0.5 * x;
  y *= 1.5 - half * y * y;
  y *= 1.5 - half * y * y;
  y *= 1.5 - half * y * y;
  return y;
}
WEAVEFORM_INLINE double inverse_of(double x) {
  const double y = inverse_root(x);
  return y * y;
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
  double twist;  // 1, or 0 on triangles
};

struct Foot {
  double xi, eta, dxi, deta;  // and its way since the step before
  double s1[3], s2[3], r[3];  // S_xi, S_eta, x - y
  double distance, inverse_distance, depth;
  double meets;  // 1, or 0 where the normals part by 90 degrees
};

// r = dxi S_xi + deta S_eta + s n, by Cramer's rule.
WEAVEFORM_INLINE Foot foot(const PlyPassLaw& law, const Common& common, const PlyPassNodes& nodes, int i) {
  const long corner = nodes.corner[i];
  const double xi = nodes.place[0][i], eta = nodes.place[1][i];
  double e1[3], e2[3], e3[3], n[3], from[3], r[3], s1[3], s2[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double* const origin = nodes.surface[c];
    const double *const first = origin + nodes.beside[0], *const second = origin + nodes.beside[1],
                        *const third = origin + nodes.beside[2];
    from[c] = nodes.x[c][i] - origin[corner];
    e1[c] = first[corner] - origin[corner];
    e2[c] = second[corner] - origin[corner];
    e3[c] = common.twist * (third[corner] - first[corner] - e2[c]);
    s1[c] = e1[c] + eta * e3[c];
    s2[c] = e2[c] + xi * e3[c];
    r[c] = from[c] - xi * e1[c] - eta * s2[c];
    n[c] = nodes.normal[c][i];
  }
  const double a[3] = {s2[1] * n[2] - s2[2] * n[1], s2[2] * n[0] - s2[0] * n[2], s2[0] * n[1] - s2[1] * n[0]};
  const double b[3] = {n[1] * s1[2] - n[2] * s1[1], n[2] * s1[0] - n[0] * s1[2], n[0] * s1[1] - n[1] * s1[0]};
  const double all = s1[0] * a[0] + s1[1] * a[1] + s1[2] * a[2];
  const double determinant = nodes.stiffness[i] > 0.0 ? all : 0.0;
  const double held = determinant > least ? determinant : 1.0;
  const double inverse = determinant > least ? inverse_of(held) : 0.0;
  Foot f;
  f.meets = determinant > least ? 1.0 : 0.0;
  f.dxi = (r[0] * a[0] + r[1] * a[1] + r[2] * a[2]) * inverse;
  f.deta = (r[0] * b[0] + r[1] * b[1] + r[2] * b[2]) * inverse;
  f.xi = xi + f.dxi;
  f.eta = eta + f.deta;
  double square = 0.0, along = 0.0;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    f.s1[c] = e1[c] + f.eta * e3[c];
    f.s2[c] = e2[c] + f.xi * e3[c];
    f.r[c] = from[c] - f.xi * e1[c] - f.eta * f.s2[c];
    square += f.r[c] * f.r[c];
    along += f.r[c] * n[c];
  }
  f.inverse_distance = inverse_root(square + least_square);
  const double guess = square * f.inverse_distance;
  f.distance = guess + 0.5 * (square - guess * guess) * f.inverse_distance;
  f.depth = law.reach - (law.side * along >= 0.0 ? f.distance : -f.distance);
  return f;
}

struct Normal {
  double force, elastic, stored;  // N, N, mJ
};

template <bool with_tables>
WEAVEFORM_INLINE Normal normal_force(const PlyPassLaw& law, const Common& common, double depth, double sinking,
                                     double k, double area) {
  const double pressed = depth > 0.0 ? depth : 0.0;
  const double soft = pressed < law.softening ? pressed : law.softening, engaged = soft * common.inverse_softening;
  const double beyond = pressed - soft;
  Normal out;
  out.elastic = k * engaged * (pressed - 0.5 * soft);
  // the integral: k p^3/(6 d) to the depth d, k ((p - d/2)^2/2 + d^2/24) beyond
  out.stored = k * (engaged * soft * soft * (1.0 / 6.0) + 0.5 * beyond * (soft + beyond));
  if constexpr (with_tables) {
    if (law.pressure.intervals > 0) {
      out.elastic = area * value_at(law.pressure, pressed);
      out.stored = area * value_at(law.pressure_energy, pressed);
    }
  }
  const double total = out.elastic + law.damping_time * k * engaged * common.inverse_time * sinking;
  out.force = total > 0.0 ? total : 0.0;
  return out;
}

struct Contribution {
  double area, normal, friction, energy, friction_work, damping_work, depth, pressure, outside;
};

// Force on the node, and through the foot on the corners; q are the components of the tangential one.
WEAVEFORM_INLINE void share_out(const PlyPassLaw& law, const Common& common, const Foot& f, double normal, double q1,
                                double q2, PlyPassForces& forces, int i) {
  const double side = f.depth < law.reach ? 1.0 : -1.0;  // beyond the surface r points the other way
  const double across = side * normal * f.inverse_distance;
  const double n3 = common.twist * f.xi * f.eta, n1 = f.xi - n3, n2 = f.eta - n3, n0 = 1.0 - f.xi - f.eta + n3;
  const double g3 = common.twist * (q1 * f.eta + q2 * f.xi), g1 = q1 - g3, g2 = q2 - g3, g0 = g3 - q1 - q2;
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const double force = across * f.r[d] + q1 * f.s1[d] + q2 * f.s2[d];
    forces.force[d][i] = force;
    forces.back[0][d][i] = g0 * f.r[d] - n0 * force;
    forces.back[1][d][i] = g1 * f.r[d] - n1 * force;
    forces.back[2][d][i] = g2 * f.r[d] - n2 * force;
    forces.back[3][d][i] = g3 * f.r[d] - n3 * force;
  }
}

template <bool with_tables>
WEAVEFORM_INLINE Contribution contribution(const PlyPassLaw& law, const Common& common, const PlyPassNodes& nodes,
                                           PlyPassForces& forces, int i) {
  const Foot f = foot(law, common, nodes, i);
  const double given = nodes.stiffness[i], k = f.meets * given, area = f.meets * law.share * nodes.area[i];
  const double kt = law.tangential * k, ct = law.damping_time * kt * common.inverse_time;
  const double sinking = f.depth - nodes.depth[i];  // over the step just made
  const Normal normal = normal_force<with_tables>(law, common, f.depth, sinking, k, area);

  // t from the anchor to the foot, u over the step just made
  const double t1 = f.xi - nodes.anchor[0][i], t2 = f.eta - nodes.anchor[1][i];
  const double q1 = kt * t1 + ct * f.dxi, q2 = kt * t2 + ct * f.deta;
  const double drag0 = nodes.drag[0][i], drag1 = nodes.drag[1][i], drag2 = nodes.drag[2][i];
  double t_square = 0.0, s_square = 0.0, u_square = 0.0, t_u = 0.0, u_drag = 0.0;
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const double t = t1 * f.s1[d] + t2 * f.s2[d], u = f.dxi * f.s1[d] + f.deta * f.s2[d];
    const double s = q1 * f.s1[d] + q2 * f.s2[d];
    t_square += t * t;
    s_square += s * s;
    u_square += u * u;
    t_u += t * u;
    u_drag += u * (drag1 * f.s1[d] + drag2 * f.s2[d]);
  }
  const double t_size = t_square * inverse_root(t_square + least_square);
  const double s_inverse = inverse_root(s_square + least_square), s_size = s_square * s_inverse;
  double limit = law.friction * normal.force, holds = f.depth > 0.0 ? 1.0 : 0.0;
  if constexpr (with_tables) {
    if (law.shear.intervals > 0) {
      holds = f.depth > law.adhesion ? 1.0 : 0.0;
      limit += holds * area * value_at(law.shear, nodes.path[i] + t_size);
    }
  }
  const double cut = s_size > limit ? limit * s_inverse : 1.0;
  share_out(law, common, f, normal.force, -cut * q1, -cut * q2, forces, i);
  forces.acts[i] = normal.force + cut * s_size;

  // a node on which nothing acts keeps what it had
  const double drag_now = normal.force - normal.elastic, slid = (1.0 - cut) * t_size * holds;
  nodes.place[0][i] = f.xi;
  nodes.place[1][i] = f.eta;
  nodes.anchor[0][i] = given > 0.0 ? f.xi - cut * t1 : nodes.anchor[0][i];
  nodes.anchor[1][i] = given > 0.0 ? f.eta - cut * t2 : nodes.anchor[1][i];
  nodes.path[i] += given > 0.0 ? slid : 0.0;
  nodes.depth[i] = given > 0.0 ? f.depth : nodes.depth[i];
  nodes.drag[0][i] = given > 0.0 ? drag_now : drag0;
  nodes.drag[1][i] = given > 0.0 ? -cut * ct * f.dxi : drag1;
  nodes.drag[2][i] = given > 0.0 ? -cut * ct * f.deta : drag2;

  Contribution out;
  out.area = f.depth > 0.0 ? area : 0.0;  // area is 0 where nothing acts
  out.normal = normal.force;
  out.friction = cut * s_size;
  out.energy = normal.stored + 0.5 * kt * cut * cut * t_square;
  // the spring's slip (1 - cut) t against half its force before, k_t (t - u), and half of now's, k_t cut t
  out.friction_work =
      common.moved * 0.5 * (kt * (1.0 - cut) * ((1.0 + cut) * t_square - t_u) - (u_drag - cut * ct * u_square));
  out.damping_work = common.moved * 0.5 * (drag0 + drag_now) * sinking;
  out.depth = given > 0.0 ? f.depth : -1e300;
  out.pressure = normal.force * inverse_of(area + least_area);
  const double low = f.xi < f.eta ? f.xi : f.eta, high = f.xi > f.eta ? f.xi : f.eta;
  const double over = common.twist > 0.0 ? high - 1.0 : f.xi + f.eta - 1.0;
  const double out_of_cell = over > -low ? over : -low;
  out.outside = given > 0.0 ? out_of_cell : -1.0;
  return out;
}

template <bool with_tables>
PlyPassSums pass(const PlyPassLaw& law_given, double inverse_time, const PlyPassNodes& nodes_given,
                 PlyPassForces& forces) {
  const PlyPassLaw law = law_given;
  const PlyPassNodes nodes = nodes_given;
  const Common common = {.inverse_softening = 1.0 / law.softening,
                         .inverse_time = inverse_time,
                         .moved = inverse_time > 0.0 ? 1.0 : 0.0,
                         .twist = nodes.beside[2] != 0 ? 1.0 : 0.0};
  double area = 0.0, normal = 0.0, friction = 0.0, energy = 0.0, friction_work = 0.0, damping_work = 0.0;
  double depth = -1e300, pressure = 0.0, outside = -1.0;
#pragma omp simd reduction(+ : area, normal, friction, energy, friction_work, damping_work) \
    reduction(max : depth, pressure, outside)
  for (int i = 0; i < nodes.count; ++i) {
    const Contribution one = contribution<with_tables>(law, common, nodes, forces, i);
    area += one.area;
    normal += one.normal;
    friction += one.friction;
    energy += one.energy;
    friction_work += one.friction_work;
    damping_work += one.damping_work;
    depth = one.depth > depth ? one.depth : depth;
    pressure = one.pressure > pressure ? one.pressure : pressure;
    outside = one.outside > outside ? one.outside : outside;
  }
  return {.area = area,
          .normal = normal,
          .friction = friction,
          .energy = energy,
          .friction_work = friction_work,
          .damping_work = damping_work,
          .depth = depth,
          .pressure = pressure,
          .outside = outside};
}

void normals(int count, const double* const (&west)[3], const double* const (&east)[3], const double* const (&south)[3],
             const double* const (&north)[3], double* const (&normal)[3]) {
  const double *wx = west[0], *wy = west[1], *wz = west[2], *ex = east[0], *ey = east[1], *ez = east[2];
  const double *sx = south[0], *sy = south[1], *sz = south[2], *nx = north[0], *ny = north[1], *nz = north[2];
  double *ox = normal[0], *oy = normal[1], *oz = normal[2];
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    const double ax = ex[i] - wx[i], ay = ey[i] - wy[i], az = ez[i] - wz[i];
    const double bx = nx[i] - sx[i], by = ny[i] - sy[i], bz = nz[i] - sz[i];
    ox[i] = ay * bz - az * by;
    oy[i] = az * bx - ax * bz;
    oz[i] = ax * by - ay * bx;
  }
}

using Four [[gnu::vector_size(32)]] = double;

void give_back(int count, const long* corner, const int (&beside)[3], const PlyPassForces& forces, double* into,
               char* touched) {
  const int away[4] = {0, beside[0], beside[1], beside[2]};
  for (int i = 0; i < count; ++i) {
    if (!(forces.acts[i] > 0.0)) continue;
    for (int a = 0; a < 4; ++a) {
      const long node = corner[i] + away[a];
      Four* const sum = reinterpret_cast<Four*>(into + 4 * node);
      const Four more = {forces.back[a][0][i], forces.back[a][1][i], forces.back[a][2][i], 0.0};
      *sum += more;
      touched[node / ply_segment] = 1;
    }
  }
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
const PlyLoops ply_loops = {.springs = pass<false>,
                            .tables = pass<true>,
                            .normals = normals,
                            .give_back = give_back,
                            .fold = fold,
                            .speed = speed};

}  // namespace weaveform::WEAVEFORM_SET
