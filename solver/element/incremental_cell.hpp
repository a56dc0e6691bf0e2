// The paper's own shear element: strain increments summed, stress increments added in a frame that rotates with the
// element (Hughes & Winget 1980; Eqs. 1, 2 of the paper), increments mapped from the yarn basis by Eqs. 8-10. Kept
// beside the exact formulations because the paper's results must be reproducible and because its error is itself a
// result.
//
// G = [g1 g2] (3 x 2) is the deformation gradient on the flat yarn directions. At the middle of a step, with E the
// element's frame (two unit columns) and M = E^T G:
//   strain increment   de = sym(E^T dG M^-1)                                                     (midpoint rule)
//   Eq. 8              ds~ = C_sh(gamma) 2 de_12 ,   gamma = sum of 2 de_12
//   Eq. 10             ds_1 = 2 cos a cos(a+th) ds~ , ds_2 = 2 sin a sin(a+th) ds~ , ds_4 = sin(2a+th) ds~
// with a the angle from e_1 to g_1 and th from g_1 to g_2. Force on [g1 g2] from the power V sigma : D:  V E sigma
// M^-T.
//
// Frames:
//   incremental   the Green-Naghdi frame of Fig. 2: G = E U, U = sqrt(G^T G) (2 x 2, closed form).
//   side_frame    e_1 along the element's side (Belytschko & Tsay 1984; LS-DYNA type 2): the element integrates strain
//                 and keeps stress in the frame of its side, while the user subroutine takes the angles a and th from F
//                 as Eq. 4 has them, in the Green-Naghdi frame it believes to be in. The two part as the cell shears.
#pragma once

#include <cmath>

#include "solver/element/shear_cell.hpp"

namespace weaveform {

enum class Frame { green_naghdi, side };

// What a cell remembers between steps.
struct CellHistory {
  double warp[3], weft[3];           // g1, g2 at the last step
  double stress1, stress2, stress4;  // MPa; in the element's frame
  double strain;                     // 1; sum of the engineering shear strain increments
  double work;                       // mJ; integral of V sigma : D dt
};
inline constexpr int cell_history_size = 11;

// A frame in the plane of two directions: E = [e1 e2] and M = E^T G, with inverse.
struct CellFrame {
  double e1[3], e2[3];
  double m11, m12, m21, m22;
  double determinant;
};

[[gnu::always_inline]] inline CellFrame green_naghdi_frame(const double (&g1)[3], const double (&g2)[3]) {
  const double a = g1[0] * g1[0] + g1[1] * g1[1] + g1[2] * g1[2];
  const double b = g1[0] * g2[0] + g1[1] * g2[1] + g1[2] * g2[2];
  const double c = g2[0] * g2[0] + g2[1] * g2[1] + g2[2] * g2[2];
  // square root of the symmetric C = G^T G: U = (C + J I)/sqrt(tr C + 2 J), J = sqrt(det C) = det U
  const double square = a * c - b * b;
  const double jacobian = std::sqrt(square > 0.0 ? square : 0.0);
  const double scale = 1.0 / std::sqrt(a + c + 2.0 * jacobian);
  CellFrame f;
  f.m11 = (a + jacobian) * scale;
  f.m12 = b * scale;
  f.m21 = f.m12;
  f.m22 = (c + jacobian) * scale;
  f.determinant = jacobian;
  const double inverse = 1.0 / jacobian;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {  // E = G U^-1
    f.e1[k] = (f.m22 * g1[k] - f.m12 * g2[k]) * inverse;
    f.e2[k] = (f.m11 * g2[k] - f.m12 * g1[k]) * inverse;
  }
  return f;
}

[[gnu::always_inline]] inline CellFrame side_frame(const double (&g1)[3], const double (&g2)[3]) {
  const double a = g1[0] * g1[0] + g1[1] * g1[1] + g1[2] * g1[2];
  const double b = g1[0] * g2[0] + g1[1] * g2[1] + g1[2] * g2[2];
  const double c = g2[0] * g2[0] + g2[1] * g2[1] + g2[2] * g2[2];
  const double square = a * c - b * b;
  CellFrame f;
  f.determinant = std::sqrt(square > 0.0 ? square : 0.0);
  f.m11 = std::sqrt(a);
  f.m12 = b / f.m11;
  f.m21 = 0.0;
  f.m22 = f.determinant / f.m11;
  const double inverse1 = 1.0 / f.m11, inverse2 = 1.0 / f.m22;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    f.e1[k] = g1[k] * inverse1;
    f.e2[k] = (g2[k] - f.m12 * f.e1[k]) * inverse2;
  }
  return f;
}

template <Frame frame>
[[gnu::always_inline]] inline CellFrame element_frame(const double (&g1)[3], const double (&g2)[3]) {
  if constexpr (frame == Frame::green_naghdi) return green_naghdi_frame(g1, g2);
  return side_frame(g1, g2);
}

// Eq. 10's factors of ds~ from the yarns' angles in the Green-Naghdi frame, where cos a = m11/|g1|, sin a = m21/|g1|
// and so on.
struct YarnMapping {
  double stress1, stress2, stress4;
};

[[gnu::always_inline]] inline YarnMapping yarn_mapping(const CellFrame& gn) {
  const double inverse = 1.0 / std::sqrt((gn.m11 * gn.m11 + gn.m21 * gn.m21) * (gn.m12 * gn.m12 + gn.m22 * gn.m22));
  return {2.0 * gn.m11 * gn.m12 * inverse, 2.0 * gn.m21 * gn.m22 * inverse,
          (gn.m21 * gn.m12 + gn.m11 * gn.m22) * inverse};
}

// Moves the history from its directions to g1, g2 and returns the nodal-force pair. `volume` = flat area * thickness.
template <Frame frame, Thickness thickness, class Shear>
[[gnu::always_inline]] inline CellForce<double> incremental_cell_force(const Shear& law, const double (&g1)[3],
                                                                       const double (&g2)[3], double volume,
                                                                       CellHistory& history) {
  double middle1[3], middle2[3], d1[3], d2[3];
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    middle1[k] = 0.5 * (history.warp[k] + g1[k]);
    middle2[k] = 0.5 * (history.weft[k] + g2[k]);
    d1[k] = g1[k] - history.warp[k];
    d2[k] = g2[k] - history.weft[k];
  }
  // E^T dG, then times M^-1
  const CellFrame middle = element_frame<frame>(middle1, middle2);
  const double r11 = middle.e1[0] * d1[0] + middle.e1[1] * d1[1] + middle.e1[2] * d1[2];
  const double r12 = middle.e1[0] * d2[0] + middle.e1[1] * d2[1] + middle.e1[2] * d2[2];
  const double r21 = middle.e2[0] * d1[0] + middle.e2[1] * d1[1] + middle.e2[2] * d1[2];
  const double r22 = middle.e2[0] * d2[0] + middle.e2[1] * d2[1] + middle.e2[2] * d2[2];
  const double inverse = 1.0 / middle.determinant;
  const double strain1 = (r11 * middle.m22 - r12 * middle.m21) * inverse;
  const double strain2 = (r22 * middle.m11 - r21 * middle.m12) * inverse;
  const double strain4 =
      (r12 * middle.m11 - r11 * middle.m12 + r21 * middle.m22 - r22 * middle.m21) * inverse;  // 2 de_12

  // Eq. 8, the tangent at the middle of the increment
  const double increment = law.tangent(history.strain + 0.5 * strain4) * strain4;
  // Eq. 10
  const YarnMapping map = yarn_mapping(frame == Frame::green_naghdi ? middle : green_naghdi_frame(middle1, middle2));
  const double stress1 = history.stress1 + map.stress1 * increment;
  const double stress2 = history.stress2 + map.stress2 * increment;
  const double stress4 = history.stress4 + map.stress4 * increment;

  const CellFrame end = element_frame<frame>(g1, g2);
  const double now = thickness == Thickness::constant ? volume * end.determinant : volume;
  const double halfway = thickness == Thickness::constant ? volume * middle.determinant : volume;
  history.work += 0.5 * halfway *
                  ((history.stress1 + stress1) * strain1 + (history.stress2 + stress2) * strain2 +
                   (history.stress4 + stress4) * strain4);
  history.strain += strain4;
  history.stress1 = stress1;
  history.stress2 = stress2;
  history.stress4 = stress4;

  // [F1 F2] = V E sigma M^-T, M^-T = [m22 -m21; -m12 m11]/det
  const double factor = now / end.determinant;
  const double a11 = factor * (stress1 * end.m22 - stress4 * end.m12),
               a12 = factor * (stress4 * end.m11 - stress1 * end.m21);
  const double a21 = factor * (stress4 * end.m22 - stress2 * end.m12),
               a22 = factor * (stress2 * end.m11 - stress4 * end.m21);
  CellForce<double> force;
#pragma GCC unroll 3
  for (int k = 0; k < 3; ++k) {
    force.warp[k] = end.e1[k] * a11 + end.e2[k] * a21;
    force.weft[k] = end.e1[k] * a12 + end.e2[k] * a22;
    history.warp[k] = g1[k];
    history.weft[k] = g2[k];
  }
  return force;
}

}  // namespace weaveform
