#include "mesher/drape/smooth_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "core/vector/eigen_vector.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

const double smooth_cosine = std::cos(30.0 * std::numbers::pi / 180.0);
constexpr std::size_t most_corners = 256;  // of a vertex, to be compared with one another

struct Corner {
  int triangle, place;  // which corner of it
  int next, previous;   // vertices; counter-clockwise
  Vector3d normal;      // of the triangle
  double angle;         // rad
};

// Corners by vertex; vertices are the same where their coordinates are.
struct Corners {
  std::vector<std::array<int, 3>> vertex;  // per triangle
  std::vector<std::vector<Corner>> around;
};

Corners find_corners(const TriangleSurface& surface, const std::vector<std::array<Vector3d, 3>>& point) {
  Corners corners;
  std::map<std::array<double, 3>, int> number;
  for (const auto& p : point) {
    auto& vertex = corners.vertex.emplace_back();
    for (int k = 0; k < 3; ++k)
      vertex[k] = number.emplace(array_of(p[k]), static_cast<int>(number.size())).first->second;
  }
  corners.around.resize(number.size());
  for (int t = 0; t < surface.size(); ++t) {
    const auto normal = surface.face_normal(t);
    for (int k = 0; k < 3; ++k) {
      const Vector3d a = point[t][(k + 1) % 3] - point[t][k], b = point[t][(k + 2) % 3] - point[t][k];
      corners.around[corners.vertex[t][k]].push_back({t, k, corners.vertex[t][(k + 1) % 3],
                                                      corners.vertex[t][(k + 2) % 3], vector_of(normal),
                                                      std::atan2(a.cross(b).norm(), a.dot(b))});
    }
  }
  return corners;
}

// Over the edge that two corners of a vertex share, from corner to corner counter-clockwise (or back): the sum of
// angle times normal of all that are smooth with `own`, up to it itself when the way leads around.
Vector3d smooth_part(const std::vector<Corner>& corners, std::size_t own, bool onwards, bool& around) {
  Vector3d sum = Vector3d::Zero();
  std::size_t here = own;
  for (std::size_t steps = 0; steps < corners.size(); ++steps) {  // bounded: edges may hold more than two triangles
    const auto next = std::find_if(corners.begin(), corners.end(), [&](const Corner& other) {
      return onwards ? other.next == corners[here].previous : other.previous == corners[here].next;
    });
    if (next == corners.end() || next->normal.dot(corners[here].normal) < smooth_cosine ||
        next->normal.dot(corners[own].normal) < smooth_cosine)
      return sum;
    here = static_cast<std::size_t>(next - corners.begin());
    around = here == own;
    if (around) return sum;
    sum += next->angle * next->normal;
  }
  return sum;
}

// Where hundreds of triangles meet, as at a pole: one normal for all if all are smooth with it.
std::optional<Vector3d> common_normal(const std::vector<Corner>& corners) {
  Vector3d sum = Vector3d::Zero();
  for (const Corner& corner : corners) sum += corner.angle * corner.normal;
  sum.normalize();
  const bool smooth =
      std::all_of(corners.begin(), corners.end(), [&](const Corner& c) { return c.normal.dot(sum) > smooth_cosine; });
  return smooth ? std::optional(sum) : std::nullopt;
}

Vector3d corner_normal(const std::vector<Corner>& corners, std::size_t own) {
  if (corners.size() > most_corners) return corners[own].normal;
  bool around = false;
  Vector3d sum = corners[own].angle * corners[own].normal + smooth_part(corners, own, true, around);
  if (!around) sum += smooth_part(corners, own, false, around);
  return sum.norm() > 0.0 ? Vector3d(sum.normalized()) : corners[own].normal;
}

}  // namespace

SmoothNormals::SmoothNormals(const TriangleSurface& surface) : facet_(surface.size()) {
  std::vector<std::array<Vector3d, 3>> point;
  for (int t = 0; t < surface.size(); ++t) {
    const auto corners = surface.corners(t);
    point.push_back({vector_of(corners[0]), vector_of(corners[1]), vector_of(corners[2])});
    facet_[t].corner = point.back();
  }
  const Corners corners = find_corners(surface, point);
  for (const auto& around : corners.around) {
    const auto common = around.size() > most_corners ? common_normal(around) : std::nullopt;
    for (std::size_t k = 0; k < around.size(); ++k)
      facet_[around[k].triangle].normal[around[k].place] = common ? *common : corner_normal(around, k);
  }
}

Vector3d SmoothNormals::at(int triangle, const Vector3d& point) const {
  const Facet& facet = facet_[triangle];
  const auto& [a, b, c] = facet.corner;
  const Vector3d twice_area = (b - a).cross(c - a);
  const double square = twice_area.squaredNorm();
  // barycentric coordinates, kept to the triangle against rounding
  const double of_b = std::clamp((point - a).cross(c - a).dot(twice_area) / square, 0.0, 1.0);
  const double of_c = std::clamp((b - a).cross(point - a).dot(twice_area) / square, 0.0, 1.0 - of_b);
  return ((1.0 - of_b - of_c) * facet.normal[0] + of_b * facet.normal[1] + of_c * facet.normal[2]).normalized();
}

}  // namespace weaveform
