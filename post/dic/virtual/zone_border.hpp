// How wide the border between two zones of a bias extension is, as simulated and as an instrument sees it: the paper
// leaves open how much of a measured border's blur is the instrument's.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "post/dic/settings/settings.hpp"
#include "post/dic/virtual/facet.hpp"
#include "post/dic/virtual/strain_window.hpp"

namespace weaveform::dic {

struct ZoneBorderWidth {
  double facet_size = 0.0, step = 0.0;  // mm; 0 for the raw field
  int window = 0;                       // points
  double ideal = 0.0;                   // mm; of a border without width through this instrument
  double ab = 0.0, bc = 0.0;            // mm; of the simulated borders A-B and B-C through it
};

struct ZoneBorders {
  double travel = 0.0;                 // mm
  std::array<double, 3> angle = {};    // rad; raw, mean over the profiles' outer fifths in zones A, B and C
  std::vector<ZoneBorderWidth> width;  // first the raw field, then one for each facet size
};

// Widths (10 to 90 % of the way, see step_width) of profiles across the middle of the borders, averaged along a part of
// the border, in the last frame. Facets overlap by half unless the settings give a step. Throws InputError when the
// scene is no bias extension.
[[nodiscard]] ZoneBorders zone_border_widths(const std::filesystem::path& result,
                                             const std::vector<double>& facet_sizes, const Settings& settings);
[[nodiscard]] std::string zone_border_table(const ZoneBorders& study);
// The same numbers: "travel_mm", "shear_angle_deg" of zones A, B, C, and "widths", the raw field's first; null where a
// border is too wide to have one.
[[nodiscard]] nlohmann::ordered_json zone_border_json(const ZoneBorders& study);

// Shear angle (rad) at a place as seen by facets of a size at a step, in a window around it, of any displacement field
// u(Vec2) -> Eigen::Vector2d; the sides of facets and window lie along x and y.
template <class Field>
[[nodiscard]] double levelled_angle(const Field& field, const Vec2& place, double facet_size, double step, int window,
                                    const YarnDirections& yarns) {
  const auto facet = facet_points(facet_size);
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  double square = 0.0;
  const int half = window / 2;
  for (int j = -half; j <= half; ++j)
    for (int i = -half; i <= half; ++i) {
      const Eigen::Vector2d offset(i * step, j * step);
      const Eigen::Vector2d mean = facet_mean(field, {place[0] + offset[0], place[1] + offset[1]}, facet);
      gradient += mean * offset.transpose();
      square += 0.5 * offset.squaredNorm();
    }
  Eigen::Matrix<double, 3, 2> whole = Eigen::Matrix<double, 3, 2>::Zero();
  whole.topRows<2>() = gradient / square;
  return shear_angle(whole, yarns);
}

// Displacement of inextensible, pin-jointed yarns around the border of zones A and B: both yarns turn by gamma/2 in A,
// only those along the border in B. The border is the line through the origin along `yarns.g1`; B lies on the side of
// `yarns.g2`. With g1, g2 at 45 and 135 deg to x and a pull along y, g1 turns by +gamma/2 and g2 by -gamma/2.
[[nodiscard]] Eigen::Vector2d ideal_zone_border(const Vec2& place, double angle, const YarnDirections& yarns);

}  // namespace weaveform::dic
