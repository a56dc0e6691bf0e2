// The plane curves that drawings are made of, as chords.
#pragma once

#include <array>
#include <vector>

namespace weaveform {

using DrawnPoint = std::array<double, 2>;

// An arc of the ellipse with these half axes from parameter `from` over `sweep` (rad), its ends included; chords within
// `tolerance` of it.
[[nodiscard]] std::vector<DrawnPoint> elliptic_arc(const DrawnPoint& centre, const DrawnPoint& first_axis,
                                                   const DrawnPoint& second_axis, double from, double sweep,
                                                   double tolerance);

// The arc between two corners of a polyline without the first one; bulge = tan of a quarter of its angle, positive
// counter-clockwise. A bulge of 0 is the line.
[[nodiscard]] std::vector<DrawnPoint> bulge_arc(const DrawnPoint& from, const DrawnPoint& to, double bulge,
                                                double tolerance);

// A spline of the given degree; knots rising, as many as control points + degree + 1 (Piegl and Tiller, "The NURBS
// Book", algorithm A3.1 by way of de Boor's). Weights all positive, as many as control points.
struct Spline {
  int degree = 3;
  std::vector<double> knot;
  std::vector<DrawnPoint> control;
  std::vector<double> weight;
};
[[nodiscard]] DrawnPoint point_on(const Spline& spline, double parameter);
[[nodiscard]] std::vector<DrawnPoint> spline_chords(const Spline& spline, double tolerance);

}  // namespace weaveform
