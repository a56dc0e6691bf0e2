// How far a mesh of cells of side L (mm) may be off, measured, and the longest L that a wanted accuracy allows. Each
// constant has the studies it is from; all are the largest that were seen, but for what docs/automatic.md says of the
// scatter. The errors are those of the mesh alone.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/scene/scene.hpp"

namespace weaveform {

// Fabric formed over a double curvature of radius F and drawn over edges of radius R, second order in both:
//   force   c_F (L/F)^2 + c_R (L/R)^2 ,   angle   a_F (L/F)^2 + a_R (L/R)^2   (deg)
// c_F = 0.41: a hemisphere of 75 mm through fillets of 40 mm, where edges hardly count: 3.5, 5.6, 8.0, 16.5 % at L/F =
// 0.29, 0.37, 0.44, 0.65 (docs/stability/tool_radius_cases.csv). What that leaves of the drawings over fillets of 12 to
// 20 mm makes c_R = 0.02 to 0.05 with contact at nodes, 0.008 to 0.02 with contact that knows the curve (docs/contact.md). Angles
// are means over patches of 20 mm: 6.6, 1.6, 1.1, 0.3 deg at coarsening 4, 2, 1.36, 1 of bench/accuracy/parts/hemisphere_60.toml,
// 1.2, 0.7, 0.5, 0.15 deg at 4, 2, 1.69, 1 of examples/hemisphere_pw_fast.toml.
struct FormingErrors {
  double form = 0.41, edge = 0.05;             // 1; of the force
  double form_angle = 44.0, edge_angle = 1.8;  // deg
  double longest = 0.8;                        // 1; of R: beyond there is no order (post/trust/coarse_on_tools.cpp)
};
[[nodiscard]] constexpr FormingErrors forming_errors(bool curved_contact) {
  return curved_contact ? FormingErrors{.edge = 0.02, .edge_angle = 0.8, .longest = 1.3} : FormingErrors{};
}

// Radii in mm, infinite where there is none.
[[nodiscard]] inline double longest_over_tools(const FormingErrors& errors, const AccuracySpec& wanted, double form,
                                               double edge) {
  const double force = errors.form / (form * form) + errors.edge / (edge * edge);
  const double angle = errors.form_angle / (form * form) + errors.edge_angle / (edge * edge);
  return std::min({std::sqrt(wanted.force / force), std::sqrt(wanted.angle / angle), errors.longest * edge});
}

// L/R of a chord on an edge alone.
[[nodiscard]] inline double longest_chord_ratio(const FormingErrors& errors, const AccuracySpec& wanted) {
  return std::min(std::sqrt(wanted.force / errors.edge), std::sqrt(wanted.angle / errors.edge_angle));
}

// Straight edges along the yarns meet all of them at the same phase, where those of round tools average over phases: from
// mesh to mesh the force of examples/cad_box.toml scatters as no formula tells, by up to 7 % between coarsening 1 and 0.5
// with contact at nodes, by 1.4 % with contact that knows the curve (docs/automatic.md). Less than this share of the
// force cannot be promised where most of the turning is about yarns.
[[nodiscard]] constexpr double promised_along_yarns(bool curved_contact) {
  return curved_contact ? 0.015 : 0.07;
}
inline constexpr double mostly_along_yarns = 0.5;

// A net draped over a radius R invents up to (180/pi)/12 (L/R)^2 deg of shear (mesher/drape/drape.hpp).
[[nodiscard]] inline double longest_of_net(const AccuracySpec& wanted, double radius) {
  return radius * std::sqrt(wanted.angle * 12.0 * std::numbers::pi / 180.0);
}

// Flat fabric of width W pulled by grips. Yarns that bend in the plane: 2.0, 0.73, 0.05 % and 0.15, 0.03 deg at L/W =
// 0.171, 0.086, 0.043 (plain weave, 32 deg; docs/accuracy.md), taken as the first order that lies above all of them. Yarns that do
// not: the load is above its limit by up to 0.8 L/W (post/trust/bias_extension_mesh.cpp).
inline constexpr double pulled_per_side = 0.117, pulled_angle_per_side = 0.9, pinned_per_side = 0.8;
[[nodiscard]] inline double longest_pulled(const AccuracySpec& wanted, double width, bool pinned) {
  return width *
         std::min(wanted.force / (pinned ? pinned_per_side : pulled_per_side), wanted.angle / pulled_angle_per_side);
}

// The same where a tool stretches fabric that grips hold at two places or more, with beams: 1.9, 3.6, 3.0, 1.4 % of the
// tool's force at L/W = 0.12, 0.1, 0.07, 0.05, and 9.4 % at 0.14 (bench/accuracy/parts/stretch_over_bar.toml).
inline constexpr double stretched_per_side = 0.4;
[[nodiscard]] inline double longest_stretched(const AccuracySpec& wanted, double width) {
  return width * std::min(wanted.force / stretched_per_side, wanted.angle / pulled_angle_per_side);
}

// A strip that hangs by its weight over the length l sags (L/l)^2 too far, and turns by some 60 deg
// (docs/elements.md#against-closed-forms).
[[nodiscard]] inline double longest_hanging(const AccuracySpec& wanted, double overhang) {
  return overhang * std::sqrt(std::min(wanted.force, wanted.angle / 60.0));
}

// A box of this smaller side holds a node and the centre of a cell however the yarns lie (side > sqrt(2) L).
[[nodiscard]] constexpr double longest_in_box(double side) {
  return side / 1.5;
}

// The field of a shear frame is uniform, and its error the same at 3, 6 and 12 cells a side (docs/accuracy.md); whatever
// else, a blank has three cells across, the fewest that a mesh may have (mesher/lattice/build.cpp).
inline constexpr double cells_in_frame = 3.0, cells_across = 3.0;

// No mesh finer than half a yarn's interval stands behind any of these (docs/accuracy.md#hemisphere).
inline constexpr double finest_coarsening = 0.5;

}  // namespace weaveform
