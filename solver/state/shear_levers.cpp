#include "solver/state/shear_levers.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/vector/eigen_vector.hpp"

namespace weaveform {

ShearLevers shear_levers(const MeshCells& cells, int cell, const std::vector<Vec3>& position) {
  const int begin = cells.offset[cell], end = cells.offset[cell + 1];
  Eigen::Vector3d g1 = Eigen::Vector3d::Zero(), g2 = Eigen::Vector3d::Zero();
  for (int a = begin; a < end; ++a) {
    const Eigen::Vector3d x = vector_of(position[cells.node[a]]);
    g1 += cells.coefficient[a][0] * x;
    g2 += cells.coefficient[a][1] * x;
  }
  const double length1 = g1.norm(), length2 = g2.norm();
  ShearLevers levers;
  levers.sine = std::clamp(g1.dot(g2) / (length1 * length2), -1.0 + 1e-9, 1.0 - 1e-9);
  for (int a = begin; a < end; ++a) {
    double& lever = levers.of_node[a - begin];
    lever = std::abs(cells.coefficient[a][0]) / length1 + std::abs(cells.coefficient[a][1]) / length2;
    levers.sum += lever;
  }
  return levers;
}

}  // namespace weaveform
