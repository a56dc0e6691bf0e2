#include "mesher/mesh/symmetry.hpp"

#include <cstddef>

namespace weaveform {
namespace {

using Vector = std::array<double, 3>;

Vector minus_twice(const Vector& v, double along, const Vector& normal) {
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

Vector mirrored_vector(const Vector& v, const SymmetryPlane& plane) {
  const Vector& n = plane.normal;
  return minus_twice(v, v[0] * n[0] + v[1] * n[1] + v[2] * n[2], n);
}

Vector mirrored_point(const Vector& x, const SymmetryPlane& plane) {
  const Vector &n = plane.normal, &p = plane.point;
  return minus_twice(x, (x[0] - p[0]) * n[0] + (x[1] - p[1]) * n[1] + (x[2] - p[2]) * n[2], n);
}

Vector mirrored_vector(Vector v, const std::vector<SymmetryPlane>& plane, unsigned which) {
  for (std::size_t k = 0; k < plane.size(); ++k)
    if ((which >> k & 1U) != 0) v = mirrored_vector(v, plane[k]);
  return v;
}

}  // namespace weaveform
