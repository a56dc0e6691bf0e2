#include "mesher/tools/triangles.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"

namespace weaveform {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Vector = Kernel::Vector_3;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Vector unit(const Vector& a) {
  const double size = std::sqrt(a.squared_length());
  return size > 0.0 ? a / size : a;
}

double angle_between(const Vector& a, const Vector& b) {
  const Vector turn = CGAL::cross_product(a, b);
  return std::atan2(std::sqrt(turn.squared_length()), a * b);
}

// In [0, 1], also where a sliver's sizes are lost in rounding and nothing is left of the whole.
double share(double part, double whole) {
  return whole > 0.0 ? std::clamp(part / whole, 0.0, 1.0) : 0.0;
}

// Closest point of a triangle and the part of it that holds it (Ericson 2005, "Real-Time Collision Detection", 5.1.5):
// 0..2 vertex, 3..5 the edge from vertex part-3 to the next, 6 the face.
struct OnTriangle {
  Point point;
  int part;
};

OnTriangle closest_on(const Kernel::Triangle_3& t, const Point& p) {
  const Point &a = t[0], &b = t[1], &c = t[2];
  const Vector ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab * ap, d2 = ac * ap;
  if (d1 <= 0.0 && d2 <= 0.0) return {a, 0};
  const double d3 = ab * bp, d4 = ac * bp;
  if (d3 >= 0.0 && d4 <= d3) return {b, 1};
  const double d5 = ab * cp, d6 = ac * cp;
  if (d6 >= 0.0 && d5 <= d6) return {c, 2};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + share(d1, d1 - d3) * ab, 3};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) return {b + share(d4 - d3, (d4 - d3) + (d5 - d6)) * (c - b), 4};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + share(d2, d2 - d6) * ac, 5};
  const double sum = va + vb + vc;
  return {a + share(vb, sum) * ab + share(vc, sum) * ac, 6};
}

// Of a triangle so thin that which part of it is the closest would be decided by rounding.
OnTriangle closest_on_sides(const Kernel::Triangle_3& t, const Point& p) {
  OnTriangle nearest{t[0], 0};
  for (int k = 0; k < 3; ++k) {
    const Vector side = t[(k + 1) % 3] - t[k];
    const Point point = t[k] + share(side * (p - t[k]), side * side) * side;
    if ((p - point).squared_length() < (p - nearest.point).squared_length()) nearest = {point, 3 + k};
  }
  return nearest;
}

bool is_thin(const Kernel::Triangle_3& t) {
  constexpr double thin = 1e-6;  // height over longest side
  double longest = 0.0;          // squared
  for (int k = 0; k < 3; ++k) longest = std::max(longest, (t[(k + 1) % 3] - t[k]).squared_length());
  return !(CGAL::cross_product(t[1] - t[0], t[2] - t[0]).squared_length() > thin * thin * longest * longest);
}

}  // namespace

struct TriangleSurface::Tree {
  Triangles triangles;
  std::vector<std::array<Vector, 7>> pseudo_normal;  // per triangle and part of it (OnTriangle)
  std::vector<std::array<bool, 7>> rim;              // the same layout: part of the rim of an open surface
  std::vector<bool> thin;                            // per triangle
  AabbTree tree;

  [[nodiscard]] OnTriangle closest(int triangle, const Point& p) const {
    return thin[triangle] ? closest_on_sides(triangles[triangle], p) : closest_on(triangles[triangle], p);
  }
};

TriangleSurface::TriangleSurface(const TriangleList& list, const std::string& where) : tree_(std::make_unique<Tree>()) {
  std::vector<Point> points;
  for (const auto& p : list.point) points.emplace_back(p[0], p[1], p[2]);
  std::vector<std::array<int, 3>> used;
  for (const auto& t : list.triangle) {
    const Kernel::Triangle_3 triangle(points[t[0]], points[t[1]], points[t[2]]);
    if (!(triangle.squared_area() > 0.0)) continue;  // slivers without area lie on their neighbours
    tree_->triangles.push_back(triangle);
    tree_->thin.push_back(is_thin(triangle));
    used.push_back(t);
  }
  if (used.empty()) throw InputError(where + ": the surface has no triangle with an area");

  std::vector<Vector> at_vertex(points.size(), Vector(0, 0, 0));
  std::map<std::pair<int, int>, Vector> at_edge;  // directed
  for (std::size_t n = 0; n < used.size(); ++n) {
    const auto& t = tree_->triangles[n];
    const Vector normal = unit(CGAL::cross_product(t[1] - t[0], t[2] - t[0]));
    for (int k = 0; k < 3; ++k) {
      const int a = used[n][k], b = used[n][(k + 1) % 3];
      at_vertex[a] = at_vertex[a] + angle_between(t[(k + 1) % 3] - t[k], t[(k + 2) % 3] - t[k]) * normal;
      if (!at_edge.emplace(std::pair(a, b), normal).second)
        throw InputError(fmt::format(
            "{}: two triangles run the same way along the edge from ({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, "
            "{:.6g}); orient all of them counter-clockwise seen from outside",
            where, points[a].x(), points[a].y(), points[a].z(), points[b].x(), points[b].y(), points[b].z()));
    }
  }
  std::vector<bool> rim_vertex(points.size(), false);
  for (const auto& [edge, normal] : at_edge)
    if (at_edge.find({edge.second, edge.first}) == at_edge.end())
      rim_vertex[edge.first] = rim_vertex[edge.second] = true;
  tree_->pseudo_normal.resize(used.size());
  tree_->rim.resize(used.size());
  for (std::size_t n = 0; n < used.size(); ++n) {
    const auto& t = tree_->triangles[n];
    const Vector normal = unit(CGAL::cross_product(t[1] - t[0], t[2] - t[0]));
    auto& pseudo = tree_->pseudo_normal[n];
    pseudo[6] = normal;
    for (int k = 0; k < 3; ++k) {
      pseudo[k] = unit(at_vertex[used[n][k]]);
      const auto other = at_edge.find({used[n][(k + 1) % 3], used[n][k]});
      pseudo[3 + k] = other == at_edge.end() ? normal : unit(normal + other->second);
      tree_->rim[n][k] = rim_vertex[used[n][k]];
      tree_->rim[n][3 + k] = other == at_edge.end();
    }
  }
  tree_->tree.insert(tree_->triangles.begin(), tree_->triangles.end());
  tree_->tree.build();
  tree_->tree.do_not_accelerate_distance_queries();  // the caller's hints do better than a tree of vertices
}

TriangleSurface::~TriangleSurface() = default;

int TriangleSurface::size() const {
  return static_cast<int>(tree_->triangles.size());
}

std::array<double, 3> TriangleSurface::face_normal(int triangle) const {
  const Vector& normal = tree_->pseudo_normal[triangle][6];
  return {normal.x(), normal.y(), normal.z()};
}

std::array<std::array<double, 3>, 3> TriangleSurface::corners(int triangle) const {
  std::array<std::array<double, 3>, 3> corners{};
  for (int k = 0; k < 3; ++k) {
    const Point& p = tree_->triangles[triangle].vertex(k);
    corners[static_cast<std::size_t>(k)] = {p.x(), p.y(), p.z()};
  }
  return corners;
}

SurfaceDistance TriangleSurface::distance(const std::array<double, 3>& point, int hint) const {
  const Point p(point[0], point[1], point[2]);
  const int guess = std::clamp(hint, 0, size() - 1);
  const auto first = tree_->triangles.cbegin();
  const auto found = tree_->tree.closest_point_and_primitive(p, {tree_->closest(guess, p).point, first + guess}).second;
  const int triangle = static_cast<int>(found - first);
  const OnTriangle nearest = tree_->closest(triangle, p);
  const Vector& pseudo = tree_->pseudo_normal[triangle][nearest.part];
  const Vector off = p - nearest.point;
  const double size = std::sqrt(off.squared_length());
  constexpr double on_surface = 1e-9;  // mm; so close that `off` has no direction left
  if (size < on_surface) return {off * pseudo, {pseudo.x(), pseudo.y(), pseudo.z()}, triangle};
  const double side = off * pseudo >= 0.0 ? 1.0 : -1.0;
  const Vector normal = off * (side / size);
  // over the surface a rim's nearest point is straight below; beside it, it is not
  constexpr double aslant = 1e-6;
  const bool beyond = tree_->rim[triangle][nearest.part] && std::abs(normal * pseudo) < 1.0 - aslant;
  return {side * size, {normal.x(), normal.y(), normal.z()}, triangle, beyond};
}

}  // namespace weaveform
