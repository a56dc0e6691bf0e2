// The memory of a cell with a history (incremental_cell.hpp) that starts sheared, as in a draped blank: that of the
// same cell sheared from flat to where it starts, as a trellis in its own plane, by the element itself. So it starts
// with the stress the formulation gives its angle, its own error included, and with the work spent on it.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/element/incremental_cell.hpp"

namespace weaveform {

inline constexpr double start_increment =
    0.25 * std::numbers::pi / 180.0;        // rad; error of its square: 1e-5 of a stress
inline constexpr double unsheared = 1e-12;  // below, direction products and stretches are rounding

// g1, g2: the directions at the start (incremental_cell.hpp). A cell that is flat but for rounding starts without
// stress.
template <Frame frame, Thickness thickness, class Shear>
[[nodiscard]] CellHistory sheared_start(const Shear& law, const double (&g1)[3], const double (&g2)[3], double volume) {
  CellHistory history{{g1[0], g1[1], g1[2]}, {g2[0], g2[1], g2[2]}, 0.0, 0.0, 0.0, 0.0, 0.0};
  const double length1 = std::hypot(g1[0], g1[1], g1[2]), length2 = std::hypot(g2[0], g2[1], g2[2]);
  double sum[3], difference[3];  // of the unit directions: along the bisectors of the yarns
  for (int k = 0; k < 3; ++k) {
    sum[k] = g1[k] / length1 + g2[k] / length2;
    difference[k] = g2[k] / length2 - g1[k] / length1;
  }
  const double along = std::hypot(sum[0], sum[1], sum[2]),
               across = std::hypot(difference[0], difference[1], difference[2]);
  const double opening = 2.0 * std::atan2(across, along);  // rad; between the yarns
  const double angle = 0.5 * std::numbers::pi - opening;
  if (std::abs(angle) < unsheared && std::abs(length1 - 1.0) < unsheared && std::abs(length2 - 1.0) < unsheared)
    return history;
  if (!(along > 0.0 && across > 0.0)) return history;  // collapsed: the run's own checks name the cell
  const int increments = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / start_increment)));
  // the flat cell: yarns at right angles about the same bisector
  const auto directions = [&](double part, double(&w1)[3], double(&w2)[3]) {
    const double half = 0.25 * std::numbers::pi - 0.5 * part * angle;
    const double l1 = 1.0 + part * (length1 - 1.0), l2 = 1.0 + part * (length2 - 1.0);
    for (int k = 0; k < 3; ++k) {
      w1[k] = l1 * (std::cos(half) * sum[k] / along - std::sin(half) * difference[k] / across);
      w2[k] = l2 * (std::cos(half) * sum[k] / along + std::sin(half) * difference[k] / across);
    }
  };
  directions(0.0, history.warp, history.weft);
  for (int n = 1; n <= increments; ++n) {
    double w1[3], w2[3];
    directions(static_cast<double>(n) / increments, w1, w2);
    (void)incremental_cell_force<frame, thickness>(law, w1, w2, volume, history);
  }
  for (int k = 0; k < 3; ++k) {
    history.warp[k] = g1[k];
    history.weft[k] = g2[k];
  }
  return history;
}

}  // namespace weaveform
