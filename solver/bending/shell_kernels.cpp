#include "solver/bending/shell_kernels.hpp"

namespace weaveform::WEAVEFORM_SET {
namespace {

struct EdgeResult {
  double force[3], bend[3], shear[3];
};

template <class Moment>
[[gnu::always_inline]] inline EdgeResult edge(const Moment& moment, const double (&e)[3], const double (&da)[3],
                                              const double (&db)[3], double yarns, double inverse_rest,
                                              double shear_stiffness) {
  constexpr double least = 1e-12;  // mm^2; elements that rows are padded with may have no length
  const double square = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
  const double inverse = 1.0 / std::sqrt(square > least ? square : least);
  double t[3], turn_vector[3], sum_vector[3];
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    t[c] = e[c] * inverse;
    turn_vector[c] = db[c] - da[c];
    sum_vector[c] = db[c] + da[c];
  }
  const double turn = t[0] * turn_vector[0] + t[1] * turn_vector[1] + t[2] * turn_vector[2];
  const double sum = t[0] * sum_vector[0] + t[1] * sum_vector[1] + t[2] * sum_vector[2];
  const EdgeForces f = shell_edge(moment, turn, sum, yarns, inverse_rest, shear_stiffness);
  // dE/dt = bend turn_vector + shear sum_vector; dt = (I - t t) de/|e|
  const double along = f.bend * turn + f.shear * sum;
  EdgeResult result;
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    result.force[c] = -inverse * (f.bend * turn_vector[c] + f.shear * sum_vector[c] - along * t[c]);
    result.bend[c] = f.bend * t[c];
    result.shear[c] = f.shear * t[c];
  }
  return result;
}

[[gnu::always_inline]] inline void store(const EdgeOutput& out, int i, const EdgeResult& result) {
#pragma GCC unroll 3
  for (int c = 0; c < 3; ++c) {
    out.force[c][i] = result.force[c];
    out.bend[c][i] = result.bend[c];
    out.shear[c][i] = result.shear[c];
  }
}

template <class Moment>
void edge_row(const void* moment_pointer, const ShellRows& row_pointers, double inverse_rest, const double* yarns,
              double shear_per_yarn, int begin, int end, const EdgeOutput& output) {
  const Moment moment = *static_cast<const Moment*>(moment_pointer);
  const ShellRows rows = row_pointers;
  const EdgeOutput out = output;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    double e[3], da[3], db[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      e[c] = rows.xb[c][i] - rows.xa[c][i];
      da[c] = rows.da[c][i];
      db[c] = rows.db[c][i];
    }
    store(out, i, edge(moment, e, da, db, yarns[i], inverse_rest, yarns[i] * shear_per_yarn));
  }
}

template <class Moment>
void loose_edges(const void* moment_pointer, const LooseEdgeView& view, const double* const (&positions)[3],
                 const double* const (&directors)[3], const EdgeOutput& output) {
  const Moment moment = *static_cast<const Moment*>(moment_pointer);
  const LooseEdgeView edges = view;
  const double* const x[3] = {positions[0], positions[1], positions[2]};
  const double* const d[3] = {directors[0], directors[1], directors[2]};
  const EdgeOutput out = output;
#pragma omp simd
  for (int k = 0; k < edges.count; ++k) {
    const int a = edges.node0[k], b = edges.node1[k];
    double e[3], da[3], db[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      e[c] = x[c][b] - x[c][a];
      da[c] = d[c][a];
      db[c] = d[c][b];
    }
    store(out, k, edge(moment, e, da, db, edges.yarns[k], edges.inverse_rest[k], edges.shear_stiffness[k]));
  }
}

EdgeKernels edge_kernels(MomentShape shape) {
  switch (shape) {
    case MomentShape::constant:
      return {&edge_row<ConstantMoment>, &loose_edges<ConstantMoment>};
    case MomentShape::short_law:
      return {&edge_row<CurvedMoment>, &loose_edges<CurvedMoment>};
    case MomentShape::long_law:
      return {&edge_row<LongMoment>, &loose_edges<LongMoment>};
    case MomentShape::sided_law:
      break;
  }
  return {&edge_row<SidedMoment>, &loose_edges<SidedMoment>};
}

void shell_twist_row(const ShellRows& row_pointers, double inverse_spacing1, double inverse_spacing2,
                     const double* stiffness, int begin, int end, const ShellTwistOutput& output) {
  const ShellRows rows = row_pointers;
  const ShellTwistOutput out = output;
  const double half1 = 0.5 * inverse_spacing1, half2 = 0.5 * inverse_spacing2;
#pragma omp simd
  for (int i = begin; i < end; ++i) {
    double g1[3], g2[3], d1[3], d2[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const double up = rows.xb[c][i + 1] - rows.xa[c][i], down = rows.xa[c][i + 1] - rows.xb[c][i];
      const double d_up = rows.db[c][i + 1] - rows.da[c][i], d_down = rows.da[c][i + 1] - rows.db[c][i];
      g1[c] = half1 * (up + down);
      g2[c] = half2 * (up - down);
      d1[c] = half1 * (d_up + d_down);
      d2[c] = half2 * (d_up - d_down);
    }
    double twist = 0.0;  // 2 kappa_12
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) twist += g1[c] * d2[c] + g2[c] * d1[c];
    const double moment = stiffness[i] * twist;
    // corner a[i] has coefficients (-half1, -half2), b[i] (-half1, +half2)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c) {
      const double x1 = half1 * moment * d2[c], x2 = half2 * moment * d1[c];
      const double y1 = half1 * moment * g2[c], y2 = half2 * moment * g1[c];
      out.xp[c][i] = x1 + x2;
      out.xq[c][i] = x1 - x2;
      out.dp[c][i] = y1 + y2;
      out.dq[c][i] = y1 - y2;
    }
  }
}

void shell_position_assemble(const double* along, const double* across, const double* across_below, const double* p,
                             const double* q, const double* p_below, const double* q_below, double* force, int begin,
                             int end) {
#pragma omp simd
  for (int i = begin; i < end; ++i)
    force[i] +=
        (along[i - 1] - along[i]) + (across_below[i] - across[i]) + (p[i] - q[i - 1]) + (q_below[i] - p_below[i - 1]);
}

void shell_director_assemble(const DirectorRow& row_pointers, double* force, int begin, int end) {
  const DirectorRow r = row_pointers;
#pragma omp simd
  for (int i = begin; i < end; ++i)
    force[i] = (r.along_bend[i] - r.along_shear[i]) - (r.along_bend[i - 1] + r.along_shear[i - 1]) +
               (r.across_bend[i] - r.across_shear[i]) - (r.below_bend[i] + r.below_shear[i]) + (r.p[i] - r.q[i - 1]) +
               (r.q_below[i] - r.p_below[i - 1]);
}

void drift_directors(double* const (&directors)[3], double* const (&velocities)[3], double time, int begin, int end) {
  double *dx = directors[0], *dy = directors[1], *dz = directors[2];
  double *vx = velocities[0], *vy = velocities[1], *vz = velocities[2];
#pragma omp simd
  for (int n = begin; n < end; ++n) {
    const double speed = vx[n] * vx[n] + vy[n] * vy[n] + vz[n] * vz[n];
    const double q = speed * time * time;  // theta^2; below 0.1 in any stable step
    const double cosine = 1.0 + q * (-1.0 / 2 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320))));
    const double sine = time * (1.0 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880)))));
    double ex = cosine * dx[n] + sine * vx[n], ey = cosine * dy[n] + sine * vy[n], ez = cosine * dz[n] + sine * vz[n];
    const double back = sine * speed;
    double wx = cosine * vx[n] - back * dx[n], wy = cosine * vy[n] - back * dy[n], wz = cosine * vz[n] - back * dz[n];
    // what rounding leaves of length and of a part of v along d
    const double inverse = 1.0 / std::sqrt(ex * ex + ey * ey + ez * ez);
    ex *= inverse;
    ey *= inverse;
    ez *= inverse;
    const double along = wx * ex + wy * ey + wz * ez;
    dx[n] = ex;
    dy[n] = ey;
    dz[n] = ez;
    vx[n] = wx - along * ex;
    vy[n] = wy - along * ey;
    vz[n] = wz - along * ez;
  }
}

void kick_directors(const double* const (&directors)[3], double* const (&velocities)[3],
                    const double* const (&forces)[3], const double* inertia, const double* inverse_inertia, double keep,
                    double kick, int begin, int end, double* sums) {
  const double *dx = directors[0], *dy = directors[1], *dz = directors[2];
  const double *fx = forces[0], *fy = forces[1], *fz = forces[2];
  double *vx = velocities[0], *vy = velocities[1], *vz = velocities[2];
  double lane[8] = {};
  for (int block = begin; block < end; block += 8) {
    const int last = block + 8 < end ? block + 8 : end;
#pragma omp simd
    for (int n = block; n < last; ++n) {
      const double along = fx[n] * dx[n] + fy[n] * dy[n] + fz[n] * dz[n];
      const double scale = kick * inverse_inertia[n];
      const double ax = keep * vx[n] + scale * (fx[n] - along * dx[n]);
      const double ay = keep * vy[n] + scale * (fy[n] - along * dy[n]);
      const double az = keep * vz[n] + scale * (fz[n] - along * dz[n]);
      const double mx = vx[n] + ax, my = vy[n] + ay, mz = vz[n] + az;
      lane[n - block] += 0.25 * inertia[n] * (mx * mx + my * my + mz * mz);
      vx[n] = ax;
      vy[n] = ay;
      vz[n] = az;
    }
  }
  for (int k = 0; k < 8; ++k) sums[k] += lane[k];
}

}  // namespace

extern const ShellLoops shell_loops;
const ShellLoops shell_loops = {.edge_kernels = edge_kernels,
                                .shell_twist_row = shell_twist_row,
                                .shell_position_assemble = shell_position_assemble,
                                .shell_director_assemble = shell_director_assemble,
                                .drift_directors = drift_directors,
                                .kick_directors = kick_directors};

}  // namespace weaveform::WEAVEFORM_SET
