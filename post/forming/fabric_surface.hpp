// The deformed fabric as a surface of triangles that carries the shear angle and the place on the flat blank.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "core/vector/eigen_vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "post/forming/part_axis.hpp"
#include "solver/result/fields.hpp"

namespace weaveform {

struct FabricPoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // mm
  Eigen::Vector3d flat = Eigen::Vector3d::Zero();   // mm; the same material point on the flat blank
  double angle = 0.0;                               // rad; shear angle
};

// Each cell is a fan of triangles around its centre. The centre has the cell's angle, a node the mean of the cells
// around it, weighted with their area: second order inside, first order on the fabric's edge.
struct FabricSurface {
  std::vector<FabricPoint> point;            // nodes, then cell centres
  std::vector<std::array<int, 3>> triangle;  // counter-clockwise seen from the flat blank's upper side
};

[[nodiscard]] FabricSurface make_surface(const Mesh& mesh, const std::vector<Vec3>& position,
                                         const std::vector<double>& shear_angle);

// mm; per node, on the flat blank.
[[nodiscard]] const std::vector<Vec3>& flat_positions(const Mesh& mesh);

// Part `t` of the way from one point to another, every component linear.
[[nodiscard]] FabricPoint between(const FabricPoint& from, const FabricPoint& to, double t);

// Where the axis passes through the fabric: in the first triangle that holds it; none when it misses.
[[nodiscard]] std::optional<FabricPoint> pole_of(const FabricSurface& surface, const PartAxis& axis);

}  // namespace weaveform
