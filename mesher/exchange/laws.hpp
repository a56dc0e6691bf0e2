// The fabric's laws as other codes take them: tables of points with straight lines between.
//
// Yarns. Axial force N = s(e) A L0/L (incompressible section) or s(e) A, e = ln(L/L0). Over the engineering strain
// x = L/L0 - 1 that is N = A f(x) with
//   f(x) = s(ln(1 + x)) / (1 + x)      or      f(x) = s(ln(1 + x)) ,
// the same for every length and section. A yarn that reaches `jaw` mm into a grip has the strain of its whole length,
// so that N = A f(x L0/(L0 + jaw)): the same table with its abscissa stretched by (L0 + jaw)/L0.
//
// Cells. The energy per flat volume is w(s), s = sin gamma = g1.g2 of the unit yarn directions, dw/ds = S(atanh s) the
// card's stress. With V0 = (flat area) t:
//   Cauchy stress   V sigma = V0 S sum_f (ds/dg_f) g_f = V0 S [g1 g2 + g2 g1 - s (g1 g1 + g2 g2)]
// Let m be the unit bisector of g1 and g2, n normal to it in the plane, theta = pi/2 - gamma the angle between them:
//   g1 g2 + g2 g1 = 2 (cos^2 m m - sin^2 n n),  g1 g1 + g2 g2 = 2 (cos^2 m m + sin^2 n n),  cos, sin of theta/2,
//   s = cos^2 - sin^2  =>  sum = 4 sin^2 cos^2 (m m - n n) = cos^2 gamma (m m - n n) .
// A fabric law that takes the stress t along m m - n n (OpenRadioss's LAW58: -rs3, (r3r3 - s3s3) of mulawc.F90 are the
// components of m m - n n) and whose shell keeps its thickness has V = V0 cos gamma, so
//   t(gamma) = cos gamma S(atanh sin gamma)      constant-volume (the cell keeps V0)
//   t(gamma) = cos^2 gamma S(atanh sin gamma)    constant thickness (Weaveform's volume is V0 cos gamma, too)
// In material axes the same law is the second Piola-Kirchhoff stress: with the Green strain 2 E12 = g1.g2 = s,
//   S12 = dw/d(2 E12) = S(atanh s)      constant-volume,      sqrt(1 - s^2) S(atanh s)      constant thickness.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "mesher/exchange/gathered.hpp"

namespace weaveform::foreign {

using Points = std::vector<std::array<double, 2>>;

// Points of `f` from the first to the last of the rising `knots`, which are among them, close enough for straight lines
// between to err by at most table_error of the value or by `absolute`, whichever is more.
inline constexpr double table_error = 2e-5;
[[nodiscard]] Points points_of(const std::function<double(double)>& f, const std::vector<double>& knots,
                               double absolute);

// At most `most` points whose broken line is the closest to `f` in the sense of least squares, so that it errs to both
// sides; the points between the knots then lie a little beside f.
[[nodiscard]] Points fitted_points(const std::function<double(double)>& f, const std::vector<double>& knots,
                                   double absolute, std::size_t most);

// Stress (MPa) of a yarn at true strain e, by the scene's model (law, slack, scale, compression, seatbelt).
[[nodiscard]] double yarn_stress(const Gathered& model, std::size_t family, double strain);
// Greatest slope of f (MPa) where a fabric's yarns get to: for steps and contact.
[[nodiscard]] double yarn_stiffness(const Gathered& model, std::size_t family);
// f above, in MPa.
[[nodiscard]] double yarn_force_per_section(const Gathered& model, std::size_t family, double engineering_strain);
// True strains at which the law has corners, from `shortest` to well past that at which the card's yarn is torn.
[[nodiscard]] std::vector<double> yarn_knots(const Gathered& model, std::size_t family, double shortest);
// f over x, from half the length on.
[[nodiscard]] Points yarn_points(const Gathered& model, std::size_t family);

// MPa; of a fabric law's own fibres: the yarns beside the cells bear tension, yet a modulus of zero is none. A
// thousandth of the shear law's initial modulus.
[[nodiscard]] double fibre_modulus(const Gathered& model);

// S12 above at s = sin gamma (MPa).
[[nodiscard]] double cell_stress(const Gathered& model, double sine);
// t (MPa) over gamma, between -greatest and greatest (deg).
[[nodiscard]] Points cell_points_by_angle(const Gathered& model, double greatest);
// Raises and lowers points away from the origin until the curve rises throughout, for codes that refuse one that does
// not. Returns the greatest change at abscissae up to `within`.
double make_rising(Points& points, double within);
// S12 over s, between the sines of -greatest and greatest (deg).
[[nodiscard]] Points cell_points_by_sine(const Gathered& model, double greatest);
// deg; the shear angle that short tables go to: 15 beyond the card's, from 75 to 85.
[[nodiscard]] double far_angle(const Gathered& model);
// Sines of shear angles at which the law has corners, between those of -greatest and greatest (deg).
[[nodiscard]] std::vector<double> cell_knots(const Gathered& model, double greatest);

// N/mm and tonne; of springs that hold a node in its place, as stiff as the stiffest yarn element or frame
// member, and so heavy that they ask for no shorter step than the yarns do.
struct HoldingSpring {
  double stiffness = 0.0, mass = 0.0;
};
[[nodiscard]] HoldingSpring holding_spring(const Gathered& model);
// N/mm; of a node's contact, as in Weaveform: a twentieth of what the yarn elements about it have together.
[[nodiscard]] double contact_stiffness(const Gathered& model);
// tonne; of a tool that the scene gives no mass: the blank's.
[[nodiscard]] double tool_mass(const Gathered& model, const ToolMotion& motion);

// Factor on a tool's force over the time: it comes on in the first 3 % of the duration, as in Weaveform; sudden, it
// would hammer the tool on the fabric.
[[nodiscard]] Points rise_of_forces(double duration);

// A frame's member: N = E A ln(L/L0) L0/L over x, for A = 1 mm^2.
[[nodiscard]] Points member_points(double modulus);

}  // namespace weaveform::foreign
