#include "mesher/mesh/symmetry.hpp"

#include <cstddef>

#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

Vec3 minus_twice(const Vec3& v, double along, const Vec3& normal) {
  return {v[0] - 2.0 * along * normal[0], v[1] - 2.0 * along * normal[1], v[2] - 2.0 * along * normal[2]};
}

}  // namespace

std::vector<double> node_share(const MeshSymmetry& symmetry, int node_count) {
  std::vector<double> share(static_cast<std::size_t>(node_count), 1.0);
  for (const auto& nodes : symmetry.on_plane)
    for (const int n : nodes) share[static_cast<std::size_t>(n)] *= 0.5;
  for (const auto& image : symmetry.image) share[static_cast<std::size_t>(image.node)] = 0.0;
  return share;
}

Vec3 mirrored_vector(const Vec3& v, const SymmetryPlane& plane) {
  const Vec3& n = plane.normal;
  return minus_twice(v, dot(v, n), n);
}

Vec3 mirrored_point(const Vec3& x, const SymmetryPlane& plane) {
  const Vec3 &n = plane.normal, &p = plane.point;
  return minus_twice(x, dot(minus(x, p), n), n);
}

Vec3 mirrored_vector(Vec3 v, const std::vector<SymmetryPlane>& plane, unsigned which) {
  for (std::size_t k = 0; k < plane.size(); ++k)
    if ((which >> k & 1U) != 0) v = mirrored_vector(v, plane[k]);
  return v;
}

std::array<Vec3, 3> reflection(const std::vector<SymmetryPlane>& plane, unsigned which) {
  std::array<Vec3, 3> rows{};
  for (int c = 0; c < 3; ++c) {
    Vec3 unit = {0.0, 0.0, 0.0};
    unit[c] = 1.0;
    const Vec3 column = mirrored_vector(unit, plane, which);
    for (int r = 0; r < 3; ++r) rows[r][c] = column[r];
  }
  return rows;
}

}  // namespace weaveform
