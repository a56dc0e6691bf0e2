// Compiled once for each instruction set (core/instructions); includes nothing whose inline code other files share.
#include "solver/contact/ply_kernel.hpp"

#include <cmath>

namespace weaveform::WEAVEFORM_SET {
namespace {

// Square roots and inverses in single precision, where 1e-7 is enough or one more step makes it so: doubles take four
// times as long.
[[gnu::always_inline]] inline double rough_inverse(double x) {
  return static_cast<double>(1.0F / static_cast<float>(x));
}
[[gnu::always_inline]] inline double rough_root(double square) {
  return static_cast<double>(std::sqrt(static_cast<float>(square)));
}

// Keep inverses finite, far below anything that matters.
constexpr double least = 1e-30, least_area = 1e-12;  // mm^4, mm^2

// Piecewise linear, x >= 0.
[[gnu::always_inline]] inline double value_at(const EvenTable& table, double x) {
  const double along = x * table.per_unit;
  const double inside = along < table.intervals ? along : table.intervals;
  int left = static_cast<int>(inside);
  left = left < table.intervals ? left : table.intervals - 1;
  const double low = table.value[left], high = table.value[left + 1];
  return low + (high - low) * (inside - left) + table.last_slope * (along - inside);
}

struct Contribution {
  double area, normal, friction, energy, friction_work, damping_work, depth, pressure, outside;
};

template <bool with_tables>
[[gnu::always_inline]] inline Contribution contribution(const PlyPassLaw& law, double inverse_softening, double inverse_time, double moved,
                                                        const PlyPassNodes& nodes, int i) {
  const int c0 = nodes.corner[0][i], c1 = nodes.corner[1][i], c2 = nodes.corner[2][i], c3 = nodes.corner[3][i];
  const double twist = c3 != c0 ? 1.0 : 0.0;  // none of a triangle
  double e1[3], e2[3], e3[3], s1[3], s2[3], r[3], x0[3], n[3];
  const double xi0 = nodes.place[0][i], eta0 = nodes.place[1][i];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    const double* s = nodes.surface[c];
    x0[c] = s[c0];
    e1[c] = s[c1] - x0[c];
    e2[c] = s[c2] - x0[c];
    e3[c] = twist * (s[c3] - s[c1] - e2[c]);
    s1[c] = e1[c] + eta0 * e3[c];
    s2[c] = e2[c] + xi0 * e3[c];
    r[c] = (nodes.x[c][i] - x0[c]) - xi0 * e1[c] - eta0 * s2[c];
    n[c] = nodes.normal[c][i];
  }
  // r = dxi S_xi + deta S_eta + s n, by Cramer's rule
  const double a[3] = {s2[1] * n[2] - s2[2] * n[1], s2[2] * n[0] - s2[0] * n[2], s2[0] * n[1] - s2[1] * n[0]};
  const double b[3] = {n[1] * s1[2] - n[2] * s1[1], n[2] * s1[0] - n[0] * s1[2], n[0] * s1[1] - n[1] * s1[0]};
  const double determinant = s1[0] * a[0] + s1[1] * a[1] + s1[2] * a[2];
  const double inverse = determinant > least ? rough_inverse(determinant) : 0.0;  // the normals part by 90 degrees
  const double dxi = (r[0] * a[0] + r[1] * a[1] + r[2] * a[2]) * inverse,
               deta = (r[0] * b[0] + r[1] * b[1] + r[2] * b[2]) * inverse;
  const double xi = xi0 + dxi, eta = eta0 + deta;
  double square = 0.0, along = 0.0;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    s1[c] = e1[c] + eta * e3[c];
    s2[c] = e2[c] + xi * e3[c];
    r[c] = (nodes.x[c][i] - x0[c]) - xi * e1[c] - eta * s2[c];
    square += r[c] * r[c];
    along += r[c] * n[c];
  }
  const double guess = rough_root(square) + 1e-18, inverse_distance = rough_inverse(guess);
  const double distance = guess + 0.5 * (square - guess * guess) * inverse_distance;
  const double p = law.reach - (law.side * along >= 0.0 ? distance : -distance);

  const double k = inverse > 0.0 ? nodes.stiffness[i] : 0.0, c = law.damping_time * k;
  const double area = k > 0.0 ? law.share * nodes.area[i] : 0.0;
  const double pressed = p > 0.0 ? p : 0.0;
  const double soft = pressed < law.softening ? pressed : law.softening, engaged = soft * inverse_softening;
  const double beyond = pressed - soft;
  double elastic = k * engaged * (pressed - 0.5 * soft);
  double stored = k * (engaged * soft * soft * (1.0 / 6.0) + 0.5 * beyond * (soft + beyond));
  if constexpr (with_tables) {
    if (law.pressure.intervals > 0) {
      elastic = area * value_at(law.pressure, pressed);
      stored = area * value_at(law.pressure_energy, pressed);
    }
  }
  const double sinking = p - nodes.depth[i];  // over the step just made
  const double total = elastic + c * engaged * inverse_time * sinking;
  const double normal = total > 0.0 ? total : 0.0;

  // way of the foot from its anchor, and over the step
  const double t1 = xi - nodes.anchor[0][i], t2 = eta - nodes.anchor[1][i];
  double t_square = 0.0, s_square = 0.0, t_u = 0.0;
  const double kt = law.tangential * k, ct = law.tangential * c * inverse_time;
  const double q1 = kt * t1 + ct * dxi, q2 = kt * t2 + ct * deta;
  double u_drag = 0.0;  // the dampers' forces over the way: that before
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const double t = t1 * s1[d] + t2 * s2[d], u = dxi * s1[d] + deta * s2[d], s = q1 * s1[d] + q2 * s2[d];
    t_square += t * t;
    t_u += t * u;
    s_square += s * s;
    u_drag += u * (nodes.drag[1][i] * s1[d] + nodes.drag[2][i] * s2[d]);
  }
  const double u_square = [&] {
    double sum = 0.0;
#pragma GCC unroll 3
    for (int d = 0; d < 3; ++d) {
      const double u = dxi * s1[d] + deta * s2[d];
      sum += u * u;
    }
    return sum;
  }();
  const double t_size = rough_root(t_square), s_size = rough_root(s_square);
  double limit = law.friction * normal;
  double holds = p > 0.0 ? 1.0 : 0.0;  // 1 or 0, as selections of selections are not vectorised
  if constexpr (with_tables) {
    if (law.shear.intervals > 0) {
      holds = p > law.adhesion ? 1.0 : 0.0;
      const double tau = value_at(law.shear, nodes.path[i] + t_size);
      limit += holds * area * tau;
    }
  }
  const double cut = s_size > limit ? limit * rough_inverse(s_size) : 1.0;
  nodes.place[0][i] = xi;
  nodes.place[1][i] = eta;
  nodes.anchor[0][i] = xi - cut * t1;
  nodes.anchor[1][i] = eta - cut * t2;
  nodes.path[i] += k > 0.0 ? holds * (1.0 - cut) * t_size : 0.0;
  nodes.depth[i] = p;
  const double drag_before = nodes.drag[0][i], drag_now = normal - elastic;
  nodes.drag[0][i] = drag_now;
  nodes.drag[1][i] = -cut * ct * dxi;
  nodes.drag[2][i] = -cut * ct * deta;

  const double w1 = -cut * q1, w2 = -cut * q2, across = normal * inverse_distance * (p < law.reach ? 1.0 : -1.0);
  const double n3 = twist * xi * eta, n1 = xi - n3, n2 = eta - n3, n0 = 1.0 - xi - eta + n3;
  const double g3 = twist * (w1 * eta + w2 * xi), g1 = w1 - g3, g2 = w2 - g3, g0 = g3 - w1 - w2;
#pragma GCC unroll 3
  for (int d = 0; d < 3; ++d) {
    const double f = across * r[d] + w1 * s1[d] + w2 * s2[d];
    nodes.force[d][i] = f;
    nodes.back[0][d][i] = g0 * r[d] - n0 * f;
    nodes.back[1][d][i] = g1 * r[d] - n1 * f;
    nodes.back[2][d][i] = g2 * r[d] - n2 * f;
    nodes.back[3][d][i] = g3 * r[d] - n3 * f;
  }
  nodes.normal_force[i] = normal;
  nodes.tangential_force[i] = cut * s_size;

  Contribution out;
  out.area = p > 0.0 ? area : 0.0;
  out.normal = normal;
  out.friction = cut * s_size;
  out.energy = stored + 0.5 * kt * cut * cut * t_square;
  out.friction_work = moved * 0.5 * (kt * (1.0 - cut) * ((1.0 + cut) * t_square - t_u) - (u_drag - cut * ct * u_square));
  out.damping_work = moved * 0.5 * (drag_before + drag_now) * sinking;
  out.depth = k > 0.0 ? p : -1e300;
  out.pressure = normal * rough_inverse(area + least_area);
  const double low = xi < eta ? xi : eta, high = xi > eta ? xi : eta;
  const double over = twist > 0.0 ? high - 1.0 : xi + eta - 1.0;
  const double out_of_cell = over > -low ? over : -low;
  out.outside = k > 0.0 ? out_of_cell : -1.0;
  return out;
}

template <bool with_tables>
PlyPassSums pass(const PlyPassLaw& law_given, double inverse_time, const PlyPassNodes& nodes_given) {
  const PlyPassLaw law = law_given;
  const PlyPassNodes nodes = nodes_given;
  const double inverse = 1.0 / law.softening, moved = inverse_time > 0.0 ? 1.0 : 0.0;
  double area = 0.0, normal = 0.0, friction = 0.0, energy = 0.0, friction_work = 0.0, damping_work = 0.0;
  double depth = -1e300, pressure = 0.0, outside = -1.0;
#pragma omp simd reduction(+ : area, normal, friction, energy, friction_work, damping_work) \
    reduction(max : depth, pressure, outside)
  for (int i = 0; i < nodes.count; ++i) {
    const Contribution one = contribution<with_tables>(law, inverse, inverse_time, moved, nodes, i);
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

void fold(int count, double* from, double* into) {
#pragma omp simd
  for (int i = 0; i < count; ++i) {
    into[i] += from[i];
    from[i] = 0.0;
  }
}

double speed(int count, const double* mass, const double* const (&v)[3]) {
  const double *vx = v[0], *vy = v[1], *vz = v[2];
  double greatest = 0.0;
#pragma omp simd reduction(max : greatest)
  for (int i = 0; i < count; ++i) {
    const double square = mass[i] > 0.0 ? vx[i] * vx[i] + vy[i] * vy[i] + vz[i] * vz[i] : 0.0;
    greatest = square > greatest ? square : greatest;
  }
  return std::sqrt(greatest);
}

}  // namespace

extern const PlyLoops ply_loops;
const PlyLoops ply_loops = {
    .springs = pass<false>, .tables = pass<true>, .normals = normals, .fold = fold, .speed = speed};

}  // namespace weaveform::WEAVEFORM_SET
