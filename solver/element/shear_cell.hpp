// Shear cell: in-plane shear only. With g1, g2 the yarn directions at the cell's centre and sin gamma = g1.g2 of their
// unit vectors, the paper's logarithmic shear strain (Eq. 6) has the closed form
//   gamma_L = -ln tan(pi/4 - gamma/2) = atanh(sin gamma) = 1/2 ln((1 + s)/(1 - s)),  s = sin gamma,
// and the contravariant stress sigma(gamma_L) is the integral of Table 3. The two whole-stress formulations differ in
// what they return for the forces on g1 and g2 (V0 = area * thickness of the flat cell):
//   energy         F = V0 sigma ds/dg       : ds/dg1 = (g2/|g2| - s g1/|g1|)/|g1|    (stored energy, exact balance)
//   contravariant  F = V0 sigma g2/(|g1||g2|) : sigma (g1 x g2 + g2 x g1) of Eq. 9, without the part along each yarn
// Thickness: constant-volume keeps V = V0; constant keeps t, so V = V0 cos gamma.
#pragma once

#include <cmath>

#include "mesher/scene/choices.hpp"
#include "solver/element/half_log.hpp"
#include "solver/element/inverse_root.hpp"

namespace weaveform {

// Vectors have two components where the scene is flat (lattice/element_loops.hpp), of which nothing else here knows.
template <class T, int components = 3>
struct CellForce {
  T warp[components];  // N; conjugate to g1, so that node a of the cell gets -(c1_a * warp + c2_a * weft)
  T weft[components];  // N; conjugate to g2
};

// a.b; without its third component the same bits as with one that is zero.
template <class T, int components>
[[gnu::always_inline]] inline T dot_product(const T (&a)[components], const T (&b)[components]) {
  const T plane = a[0] * b[0] + a[1] * b[1];
  if constexpr (components == 3)
    return plane + a[2] * b[2];
  else
    return plane;
}

// Packed shear law, odd in the strain: the tangent polynomial and, where `started`, the card's friction-like start, which
// costs a division.
template <class Law, bool started = true>
struct KernelShear {
  Law law;
  double plateau = 0.0;  // MPa
  double rise = 1.0;     // 1

  template <class T>
  [[gnu::always_inline]] inline T stress(const T& log_strain) const {
    const T size = magnitude(log_strain);
    T stress = law.stress(size);
    if constexpr (started) stress += plateau * size / (size + rise);
    return signed_like(stress, log_strain);
  }

  // C_sh (MPa), even in the strain
  [[gnu::always_inline]] inline double tangent(double log_strain) const {
    const double size = std::abs(log_strain);
    if constexpr (!started) return law.tangent(size);
    return law.tangent(size) + plateau * rise / ((size + rise) * (size + rise));
  }
};

// How a cell is sheared: |g1|^2, |g2|^2, 1/(|g1| |g2|) and sin gamma.
template <class T>
struct CellShear {
  T square1, square2, inverse, sine;
};

template <class T, int components>
[[gnu::always_inline]] inline CellShear<T> cell_shear(const T (&g1)[components], const T (&g2)[components]) {
  // a cell without area, as blocks are filled up with, may have no directions
  constexpr double least = 1e-12;
  const T square1 = at_least<T>(dot_product(g1, g1), least);
  const T square2 = at_least<T>(dot_product(g2, g2), least);
  const T dot = dot_product(g1, g2);
  const T inverse = inverse_root<T>(square1 * square2);
  // A cell at |gamma| = 90 deg has no area left; the clamp keeps the logarithm finite and the run's checks report the
  // cell.
  constexpr double limit = std::is_same_v<Real<T>, float> ? 1.0 - 6e-8 : 1.0 - 1e-12;
  return {square1, square2, inverse, at_least(at_most<T>(dot * inverse, limit), -limit)};
}

// Of the volume times the stress, `force` (N mm).
template <Formulation formulation, class T, int components>
[[gnu::always_inline]] inline CellForce<T, components> sheared_cell_force(const CellShear<T>& shear,
                                                                          const T (&g1)[components],
                                                                          const T (&g2)[components], const T& force) {
  const T cross = force * shear.inverse;
  CellForce<T, components> result;
  if constexpr (formulation == Formulation::energy) {
    const T per_area = force * shear.sine * (shear.inverse * shear.inverse);  // force * s / square1 / square2
    const T along1 = per_area * shear.square2, along2 = per_area * shear.square1;
#pragma GCC unroll 3
    for (int c = 0; c < components; ++c) {
      result.warp[c] = cross * g2[c] - along1 * g1[c];
      result.weft[c] = cross * g1[c] - along2 * g2[c];
    }
  } else {
#pragma GCC unroll 3
    for (int c = 0; c < components; ++c) {
      result.warp[c] = cross * g2[c];
      result.weft[c] = cross * g1[c];
    }
  }
  return result;
}

// Sets `square` to sin^2 gamma.
template <Formulation formulation, Thickness thickness, class Shear, class T, int components>
[[gnu::always_inline]] inline CellForce<T, components> shear_cell_force(const Shear& law, const T (&g1)[components],
                                                                        const T (&g2)[components], const T& volume,
                                                                        T& square) {
  static_assert(formulation == Formulation::energy || formulation == Formulation::contravariant,
                "the formulations with a history have kernels of their own (incremental_cell.hpp)");
  const CellShear<T> shear = cell_shear(g1, g2);
  square = shear.sine * shear.sine;
  T force = volume * law.stress(half_log<T>(1.0 + shear.sine, 1.0 - shear.sine));
  if constexpr (thickness == Thickness::constant)
    force = force * ((1.0 - square) * inverse_root<T>(1.0 - square));  // cos gamma
  return sheared_cell_force<formulation>(shear, g1, g2, force);
}

}  // namespace weaveform
