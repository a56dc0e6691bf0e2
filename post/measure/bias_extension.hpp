// Theory of the bias extension of a rectangle with inextensible yarns at 45 deg to the pull: three zones of homogeneous
// shear, the angle of Eq. 14 of the paper for any length-to-width ratio, and the load from the power balance.
// Derivation in docs/bias_extension.md. Lengths in mm, angles in rad, forces in N.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fabric/card/card.hpp"
#include "fabric/trellis/bias_rectangle.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform {

struct BiasSpecimen {
  double width = 0.0;                          // mm; W, across the pull
  double length = 0.0;                         // mm; L > W, from grip to grip
  int axis = 1;                                // of the pull in the blank's frame: 0 = x, 1 = y
  std::array<std::string, 2> grip;             // names, first the one on the lower side of the axis
  std::array<double, 2> outward = {1.0, 1.0};  // +1 when a grip's direction points out of the specimen, else -1
  [[nodiscard]] BiasRectangle rectangle() const { return {width, length}; }
  [[nodiscard]] double free_length() const { return length - width; }  // mm; D
  bool operator==(const BiasSpecimen&) const = default;
};

// The specimen of a scene: a rectangle with yarns at 45 deg, held by two whole opposite edges that are longer apart
// than they are wide and move along the line that joins them. Nothing when the scene is another test.
[[nodiscard]] std::optional<BiasSpecimen> find_bias_extension(const Scene& scene);
// The same of a stack: each ply's scene is that of one specimen, of the same size and held by the same grips.
[[nodiscard]] std::optional<BiasSpecimen> find_bias_extension(const std::vector<const Scene*>& plies);

// trellis.hpp for a specimen: flat areas (mm^2) of the zones, and the angle of Eq. 14 at the grips' travel apart (not a
// number from 90 deg on).
using ZoneAreas = BiasZones;
[[nodiscard]] inline ZoneAreas zone_areas(const BiasSpecimen& specimen) {
  return bias_zones(specimen.rectangle());
}
[[nodiscard]] inline double kinematic_shear_angle(const BiasSpecimen& specimen, double travel) {
  return bias_shear_angle(specimen.rectangle(), travel);
}

// F = t sum_z A_z sigma(gamma_z) cos(gamma_z) d gamma_z / d delta, sigma the card's stress at atanh(sin gamma_z); for a
// constant thickness each term has another factor cos gamma_z. Not a number where the angle is none or reaches 90 deg.
[[nodiscard]] double inextensible_bias_load(const BiasSpecimen& specimen, const ShearCard& shear, double thickness,
                                            Thickness rule, double travel);

}  // namespace weaveform
