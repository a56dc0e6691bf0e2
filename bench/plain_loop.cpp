// Compiled for the machine it runs on, with relaxed floating point (bench/CMakeLists.txt).
#include "bench/plain_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

namespace weaveform {
namespace {

constexpr double interval = 4.92;  // mm

template <class Real>
struct Trellis {
  int nx, ny;
  std::vector<Real> x, y, z, vx, vy, vz, fx, fy, fz;
  std::vector<Real> gx, gy, gz, hx, hy, hz;  // of one row of cells: forces on the corners

  explicit Trellis(int n) : nx(n), ny(n) {
    for (auto* field : {&x, &y, &z, &vx, &vy, &vz, &fx, &fy, &fz}) field->assign(static_cast<std::size_t>(n) * n, 0);
    for (auto* row : {&gx, &gy, &gz, &hx, &hy, &hz}) row->assign(n, 0);
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const std::size_t a = static_cast<std::size_t>(j) * nx + i;
        x[a] = Real(interval * i);
        y[a] = Real(interval * j + 0.001 * i);
        z[a] = Real(0.01 * std::sin(i * 0.1) * std::cos(j * 0.13));
      }
  }
};

template <class Real>
inline Real yarn_stress(Real e) {
  constexpr Real border = Real(0.0264), cubic = Real(1.07e9 / 4);
  const Real square = e * e;
  const Real curved = cubic * square * square;
  const Real straight = cubic * border * border * border * border + Real(19800) * (e - border);
  const Real stretched = e > border ? straight : curved;
  return e < 0 ? Real(198) * e : stretched;
}

// N/L; the strain by four terms of its logarithm.
template <class Real>
inline Real yarn_force(Real dx, Real dy, Real dz) {
  constexpr Real inverse = Real(1 / interval), area = Real(1.25);
  const Real square = dx * dx + dy * dy + dz * dz;
  const Real r = square * inverse * inverse - 1;
  const Real e = Real(0.5) * r * (1 - r * (Real(0.5) - r * (Real(1) / 3 - r * Real(0.25))));
  return yarn_stress(e) * area * Real(interval) / square;
}

template <class Real>
void warp(Trellis<Real>& m, std::size_t row) {
  const Real *x = m.x.data() + row, *y = m.y.data() + row, *z = m.z.data() + row;
  Real *fx = m.fx.data() + row, *fy = m.fy.data() + row, *fz = m.fz.data() + row;
#pragma omp simd
  for (int i = 0; i < m.nx - 1; ++i) {
    const Real dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], dz = z[i + 1] - z[i], n = yarn_force(dx, dy, dz);
    fx[i] += n * dx;
    fy[i] += n * dy;
    fz[i] += n * dz;
  }
#pragma omp simd
  for (int i = 0; i < m.nx - 1; ++i) {
    const Real dx = x[i + 1] - x[i], dy = y[i + 1] - y[i], dz = z[i + 1] - z[i], n = yarn_force(dx, dy, dz);
    fx[i + 1] -= n * dx;
    fy[i + 1] -= n * dy;
    fz[i + 1] -= n * dz;
  }
}

template <class Real>
void weft(Trellis<Real>& m, std::size_t row) {
  const Real *x = m.x.data() + row, *y = m.y.data() + row, *z = m.z.data() + row;
  Real *fx = m.fx.data() + row, *fy = m.fy.data() + row, *fz = m.fz.data() + row;
  const int up = m.nx;
#pragma omp simd
  for (int i = 0; i < m.nx; ++i) {
    const Real dx = x[i + up] - x[i], dy = y[i + up] - y[i], dz = z[i + up] - z[i], n = yarn_force(dx, dy, dz);
    fx[i] += n * dx;
    fy[i] += n * dy;
    fz[i] += n * dz;
    fx[i + up] -= n * dx;
    fy[i + up] -= n * dy;
    fz[i + up] -= n * dz;
  }
}

template <class Real>
void cells(Trellis<Real>& m, std::size_t row) {
  const Real *x = m.x.data() + row, *y = m.y.data() + row, *z = m.z.data() + row;
  Real *fx = m.fx.data() + row, *fy = m.fy.data() + row, *fz = m.fz.data() + row;
  Real *gx = m.gx.data(), *gy = m.gy.data(), *gz = m.gz.data(), *hx = m.hx.data(), *hy = m.hy.data(), *hz = m.hz.data();
  const int up = m.nx;
#pragma omp simd
  for (int i = 0; i < m.nx - 1; ++i) {
    const int b = i + up;
    constexpr Real half = Real(0.5);
    Real ux = half * (x[i + 1] - x[i] + x[b + 1] - x[b]), uy = half * (y[i + 1] - y[i] + y[b + 1] - y[b]),
         uz = half * (z[i + 1] - z[i] + z[b + 1] - z[b]);
    Real wx = half * (x[b] - x[i] + x[b + 1] - x[i + 1]), wy = half * (y[b] - y[i] + y[b + 1] - y[i + 1]),
         wz = half * (z[b] - z[i] + z[b + 1] - z[i + 1]);
    const Real iu = 1 / std::sqrt(ux * ux + uy * uy + uz * uz), iw = 1 / std::sqrt(wx * wx + wy * wy + wz * wz);
    ux *= iu;
    uy *= iu;
    uz *= iu;
    wx *= iw;
    wy *= iw;
    wz *= iw;
    const Real s = ux * wx + uy * wy + uz * wz, size = std::fabs(s);
    const Real g = half * std::log((1 + size) / (1 - size));
    Real stress = (((Real(0.42) * g + Real(0.313)) * g - Real(0.533)) * g + Real(0.264)) * g;
    stress = s < 0 ? -stress : stress;
    const Real c = stress * Real(interval * interval * 0.25);
    const Real ax = c * iu * (wx - s * ux), ay = c * iu * (wy - s * uy), az = c * iu * (wz - s * uz);
    const Real bx = c * iw * (ux - s * wx), by = c * iw * (uy - s * wy), bz = c * iw * (uz - s * wz);
    gx[i] = ax + bx;
    gy[i] = ay + by;
    gz[i] = az + bz;
    hx[i] = ax - bx;
    hy[i] = ay - by;
    hz[i] = az - bz;
  }
#pragma omp simd
  for (int i = 0; i < m.nx - 1; ++i) {
    fx[i] += gx[i];
    fy[i] += gy[i];
    fz[i] += gz[i];
    fx[i + up] += hx[i];
    fy[i + up] += hy[i];
    fz[i + up] += hz[i];
  }
#pragma omp simd
  for (int i = 0; i < m.nx - 1; ++i) {
    fx[i + 1] -= hx[i];
    fy[i + 1] -= hy[i];
    fz[i + 1] -= hz[i];
    fx[i + up + 1] -= gx[i];
    fy[i + up + 1] -= gy[i];
    fz[i + up + 1] -= gz[i];
  }
}

template <class Real>
void move(Trellis<Real>& m, Real step) {
  const Real kick = step / Real(2e-8), keep = Real(0.9999);
  Real *x = m.x.data(), *y = m.y.data(), *z = m.z.data(), *vx = m.vx.data(), *vy = m.vy.data(), *vz = m.vz.data();
  const Real *fx = m.fx.data(), *fy = m.fy.data(), *fz = m.fz.data();
  const std::size_t count = m.x.size();
#pragma omp simd
  for (std::size_t a = 0; a < count; ++a) {
    vx[a] = keep * vx[a] + kick * fx[a];
    vy[a] = keep * vy[a] + kick * fy[a];
    vz[a] = keep * vz[a] + kick * fz[a];
    x[a] += step * vx[a];
    y[a] += step * vy[a];
    z[a] += step * vz[a];
  }
}

template <class Real>
void make_step(Trellis<Real>& m) {
  for (auto* force : {&m.fx, &m.fy, &m.fz}) std::fill(force->begin(), force->end(), Real(0));
  for (int j = 0; j < m.ny; ++j) {
    warp(m, static_cast<std::size_t>(j) * m.nx);
    if (j + 1 == m.ny) continue;
    weft(m, static_cast<std::size_t>(j) * m.nx);
    cells(m, static_cast<std::size_t>(j) * m.nx);
  }
  move(m, Real(1e-7));
}

}  // namespace

template <class Real>
double plain_loop_rate(int n, double seconds) {
  using Clock = std::chrono::steady_clock;
  Trellis<Real> trellis(n);
  for (int warm = 0; warm < 3; ++warm) make_step(trellis);
  long steps = 0;
  double passed = 0.0;
  for (const auto begin = Clock::now(); passed < seconds;
       passed = std::chrono::duration<double>(Clock::now() - begin).count()) {
    for (int k = 0; k < 4; ++k) make_step(trellis);
    steps += 4;
  }
  return 1e-6 * static_cast<double>(n) * n * static_cast<double>(steps) / passed;
}

template double plain_loop_rate<double>(int, double);
template double plain_loop_rate<float>(int, double);

}  // namespace weaveform
