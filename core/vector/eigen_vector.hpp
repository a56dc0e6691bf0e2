// Between the arrays of vector.hpp and Eigen's vectors, for those who do geometry with the latter.
#pragma once

#include <Eigen/Core>

#include "core/vector/vector.hpp"

namespace weaveform {

[[nodiscard]] inline Eigen::Vector3d vector_of(const Vec3& a) {
  return {a[0], a[1], a[2]};
}

[[nodiscard]] inline Vec3 array_of(const Eigen::Vector3d& a) {
  return {a.x(), a.y(), a.z()};
}

// Zero stays zero.
[[nodiscard]] inline Eigen::Vector3d unit_or_zero(const Eigen::Vector3d& a) {
  const double length = a.norm();
  return length > 0.0 ? Eigen::Vector3d(a / length) : a;
}

}  // namespace weaveform
