// The shear angle along a meridian: where the half-plane at an azimuth about the part's axis cuts the deformed fabric.
#pragma once

#include <vector>

#include "post/forming/fabric_surface.hpp"

namespace weaveform {

struct MeridianPoint {
  double arc = 0.0;                                 // mm; along the deformed fabric from the axis
  double angle = 0.0;                               // rad; shear angle, interpolated (fabric_surface.hpp)
  double height = 0.0;                              // mm; along the axis from the plane of the flat blank, upwards
  double radius = 0.0;                              // mm; from the axis
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // mm
};

// From the axis outwards to the fabric's edge, a point wherever the cut crosses an edge of a triangle; `azimuth` (rad)
// counts from the warp. Where the axis passes through folds of the fabric, one of them is followed. Empty when the
// half-plane meets no fabric.
[[nodiscard]] std::vector<MeridianPoint> meridian(const FabricSurface& surface, const PartAxis& axis, double azimuth);

}  // namespace weaveform
