#include "mesher/tools/triangle_report.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "core/error.hpp"
#include "core/vector/vector.hpp"

namespace weaveform {
namespace {

using Triangle = std::array<int, 3>;
namespace pmp = CGAL::Polygon_mesh_processing;
using ExactKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<ExactKernel::Point_3>;

Vec3 doubled_area(const TriangleList& list, const Triangle& t) {
  return cross(minus(list.point[t[1]], list.point[t[0]]), minus(list.point[t[2]], list.point[t[0]]));
}
double longest_side(const TriangleList& list, const Triangle& t) {
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
    longest = std::max(longest, plain_length(minus(list.point[t[k]], list.point[t[(k + 1) % 3]])));
  return longest;
}
Vec3 centre(const TriangleList& list, const Triangle& t) {
  Vec3 sum = {0.0, 0.0, 0.0};
  for (const int n : t)
    for (int c = 0; c < 3; ++c) sum[c] += list.point[n][c] / 3.0;
  return sum;
}

void measure_box(const TriangleList& list, TriangleReport& report) {
  report.low.fill(std::numeric_limits<double>::infinity());
  report.high.fill(-std::numeric_limits<double>::infinity());
  for (const auto& t : list.triangle)
    for (const int n : t)
      for (int c = 0; c < 3; ++c) {
        report.low[c] = std::min(report.low[c], list.point[n][c]);
        report.high[c] = std::max(report.high[c], list.point[n][c]);
      }
}

// Sides met once are of a rim, sides met twice the same way are turned.
std::vector<std::array<int, 2>> rim_sides(const TriangleList& list, TriangleReport& report) {
  std::map<std::array<int, 2>, int> side;
  for (const auto& t : list.triangle)
    for (int k = 0; k < 3; ++k) ++side[{t[k], t[(k + 1) % 3]}];
  std::vector<std::array<int, 2>> rim;
  for (const auto& [s, count] : side) {
    const auto other = side.find({s[1], s[0]});
    if (count > 1) {
      Vec3 middle;
      for (int c = 0; c < 3; ++c) middle[c] = 0.5 * (list.point[s[0]][c] + list.point[s[1]][c]);
      report.turned.push_back({middle, plain_length(minus(list.point[s[0]], list.point[s[1]]))});
    } else if (other == side.end()) {
      rim.push_back(s);
    }
  }
  return rim;
}

// Sides of a rim joined to loops; one that encloses little for its length is a gap.
void join_rims(const TriangleList& list, const std::vector<std::array<int, 2>>& rim, TriangleReport& report) {
  std::map<int, std::vector<int>> next;
  for (const auto& s : rim) next[s[0]].push_back(s[1]);
  while (!next.empty()) {
    std::vector<int> loop = {next.begin()->first};
    for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
      const int to = at->second.back();
      at->second.pop_back();
      if (at->second.empty()) next.erase(at);
      if (to == loop.front()) break;
      loop.push_back(to);
    }
    double perimeter = 0.0;
    Vec3 area = {0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec3 a = minus(list.point[loop[k]], list.point[loop[0]]),
                 b = minus(list.point[loop[(k + 1) % loop.size()]], list.point[loop[0]]);
      perimeter += plain_length(minus(b, a));
      const Vec3 part = cross(a, b);
      for (int c = 0; c < 3; ++c) area[c] += 0.5 * part[c];
    }
    constexpr double slim =
        1e-3;  // of the perimeter squared; a circle has 0.08, a strip 250 times as long as wide has this
    (plain_length(area) < slim * perimeter * perimeter ? report.gaps : report.rims)
        .push_back({list.point[loop[0]], perimeter});
  }
}

// Connected by shared vertices.
std::vector<int> pieces_of(const TriangleList& list, int& count) {
  std::vector<int> parent(list.point.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  for (const auto& t : list.triangle) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  std::map<int, int> number;
  std::vector<int> piece;
  for (const auto& t : list.triangle)
    piece.push_back(number.emplace(root(t[0]), static_cast<int>(number.size())).first->second);
  count = static_cast<int>(number.size());
  return piece;
}

// Triangles with an area, all turned alike.
struct Soup {
  std::vector<ExactKernel::Point_3> points;
  std::vector<std::vector<std::size_t>> polygons;
};
Soup oriented_soup(const TriangleList& list) {
  Soup soup;
  for (const auto& p : list.point) soup.points.emplace_back(p[0], p[1], p[2]);
  for (const auto& t : list.triangle)
    if (plain_length(doubled_area(list, t)) > 0.0)
      soup.polygons.push_back(
          {static_cast<std::size_t>(t[0]), static_cast<std::size_t>(t[1]), static_cast<std::size_t>(t[2])});
  pmp::orient_polygon_soup(soup.points, soup.polygons);
  return soup;
}

// CGAL's own checks, of whatever build, are about the surface here.
template <class Work>
auto with_cgal(const Work& work) {
  try {
    return work();
  } catch (const CGAL::Failure_exception& failure) {
    throw InputError(
        fmt::format("a surface of triangles cannot be made of these (CGAL: {}); repair it where it was "
                    "made",
                    failure.message().empty() ? failure.expression() : failure.message()));
  }
}

void find_intersections(const TriangleList& list, TriangleReport& report) {
  auto [points, polygons] = oriented_soup(list);
  if (polygons.empty()) return;
  SurfaceMesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  std::set<SurfaceMesh::Face_index> seen;
  for (const auto& pair : pairs) {
    if (!seen.insert(pair.first).second) continue;
    Vec3 sum = {0.0, 0.0, 0.0};
    double longest = 0.0;
    for (const auto halfedge : CGAL::halfedges_around_face(mesh.halfedge(pair.first), mesh)) {
      const auto &a = mesh.point(mesh.source(halfedge)), &b = mesh.point(mesh.target(halfedge));
      longest = std::max(longest, std::sqrt(CGAL::squared_distance(a, b)));
      sum = {sum[0] + b.x() / 3.0, sum[1] + b.y() / 3.0, sum[2] + b.z() / 3.0};
    }
    report.intersections.push_back({sum, longest});
  }
}

std::vector<double> signed_volumes(const TriangleList& list, const std::vector<int>& piece, int count) {
  std::vector<double> volume(count, 0.0);
  const Vec3 origin = list.point[list.triangle[0][0]];  // from the surface itself, for the digits
  for (std::size_t n = 0; n < list.triangle.size(); ++n)
    volume[piece[n]] += dot(minus(list.point[list.triangle[n][0]], origin), doubled_area(list, list.triangle[n])) / 6.0;
  return volume;
}

}  // namespace

double TriangleReport::extent() const {
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

TriangleReport inspect(const TriangleList& list) {
  TriangleReport report;
  report.triangles = static_cast<int>(list.triangle.size());
  if (list.triangle.empty()) return report;
  measure_box(list, report);
  constexpr double thin = 1e-6;
  for (const auto& t : list.triangle) {
    const double twice = plain_length(doubled_area(list, t)), side = longest_side(list, t);
    report.area += 0.5 * twice;
    if (twice <= thin * report.extent() * side) report.degenerate.push_back({centre(list, t), side});
  }
  const auto rim = rim_sides(list, report);
  report.closed = rim.empty();
  join_rims(list, rim, report);
  const std::vector<int> piece = pieces_of(list, report.pieces);
  if (report.closed)
    for (const double v : signed_volumes(list, piece, report.pieces)) report.volume += v;
  with_cgal([&] { find_intersections(list, report); });
  return report;
}

std::string describe_faults(const TriangleReport& report) {
  std::string text;
  const auto add = [&](const std::vector<SurfaceFault>& faults, const char* what) {
    constexpr std::size_t most = 5;
    for (std::size_t k = 0; k < std::min(most, faults.size()); ++k)
      text += fmt::format("warning: at ({:.6g}, {:.6g}, {:.6g}) mm: {}, {:.3g} mm\n", faults[k].at[0], faults[k].at[1],
                          faults[k].at[2], what, faults[k].size);
    if (faults.size() > most) text += fmt::format("warning: and {} more of these\n", faults.size() - most);
  };
  add(report.gaps, "a gap between faces, along");
  add(report.turned, "two triangles that turn oppositely share a side of");
  add(report.degenerate, "a triangle without area, longest side");
  add(report.intersections, "another part of the surface passes through a triangle with a side of");
  return text;
}

bool turned_inward(const TriangleList& list) {
  TriangleReport sides;
  if (list.triangle.empty() || !rim_sides(list, sides).empty()) return false;
  double volume = 0.0;
  const std::vector<int> one_piece(list.triangle.size(), 0);
  for (const double v : signed_volumes(list, one_piece, 1)) volume += v;
  return volume < 0.0;
}

TriangleList turned_over(TriangleList list) {
  for (auto& t : list.triangle) std::swap(t[1], t[2]);
  return list;
}

TriangleList turned_alike(const TriangleList& list, const Vec3& outside) {
  auto [points, polygons] = with_cgal([&] { return oriented_soup(list); });
  if (polygons.empty()) throw InputError("the surface has no triangle with an area; repair it where it was made");
  TriangleList result;
  for (const auto& p : points) result.point.push_back({p.x(), p.y(), p.z()});
  for (const auto& p : polygons)
    result.triangle.push_back({static_cast<int>(p[0]), static_cast<int>(p[1]), static_cast<int>(p[2])});
  int count = 0;
  const std::vector<int> piece = pieces_of(result, count);
  std::vector<double> sense = signed_volumes(result, piece, count);
  std::vector<bool> open(count, false);
  std::map<std::array<int, 2>, int> side;
  for (std::size_t n = 0; n < result.triangle.size(); ++n)
    for (int k = 0; k < 3; ++k) side[{result.triangle[n][k], result.triangle[n][(k + 1) % 3]}] = piece[n];
  for (const auto& [s, p] : side)
    if (side.find({s[1], s[0]}) == side.end()) open[p] = true;
  // an open piece is judged by its triangle nearest to the point outside
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n < result.triangle.size(); ++n) {
    if (!open[piece[n]]) continue;
    const Vec3 off = minus(outside, centre(result, result.triangle[n]));
    if (plain_length(off) >= least[piece[n]]) continue;
    least[piece[n]] = plain_length(off);
    sense[piece[n]] = dot(off, doubled_area(result, result.triangle[n]));
  }
  for (std::size_t n = 0; n < result.triangle.size(); ++n)
    if (sense[piece[n]] < 0.0) std::swap(result.triangle[n][1], result.triangle[n][2]);
  return result;
}

}  // namespace weaveform
