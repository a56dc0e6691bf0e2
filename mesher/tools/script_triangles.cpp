#include "mesher/tools/script_triangles.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/guard/guarded.hpp"
#include "core/vector/vector.hpp"

namespace weaveform {

namespace {

constexpr double finest_share = 1e-6;  // of the extent; a tolerance that wants more is a slip of the pen
constexpr double longest = 0.25;       // of the extent; a side of nothing that curves
constexpr int most_script_rounds = 8;
constexpr int samples = 12;  // of curvature along each parameter

double extent_of_model() {
  double low[3], high[3];
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Vec3 point_at(const std::vector<double>& values, std::size_t k) {
  return {values[3 * k], values[3 * k + 1], values[3 * k + 2]};
}

// 1/mm; of the arc through three near points, seen along `way` (unit), which for a face is its normal: 2 s / (h/2)^2.
double bend(const Vec3& before, const Vec3& at, const Vec3& after, const Vec3& way) {
  const Vec3 chord = minus(after, before);
  const Vec3 off = {at[0] - 0.5 * (before[0] + after[0]), at[1] - 0.5 * (before[1] + after[1]),
                    at[2] - 0.5 * (before[2] + after[2])};
  const double square = dot(chord, chord);
  return square > 0.0 ? 8.0 * std::abs(dot(off, way)) / square : 0.0;
}

// Of length 1, or nothing where there is no direction.
Vec3 unit_or_zero(const Vec3& a) {
  const double length = plain_length(a);
  return length > 0.0 ? divided(a, length) : Vec3{0.0, 0.0, 0.0};
}

double curvature_of_curve(int curve) {
  std::vector<double> low, high, at, on;
  gmsh::model::getParametrizationBounds(1, curve, low, high);
  for (int k = 0; k <= samples; ++k) at.push_back(low[0] + (high[0] - low[0]) * k / samples);
  gmsh::model::getValue(1, curve, at, on);
  double greatest = 0.0;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) {
    const Vec3 a = point_at(on, k - 1), x = point_at(on, k), b = point_at(on, k + 1), chord = unit_or_zero(minus(b, a));
    const Vec3 off = minus(x, a);
    const double along = dot(off, chord);
    greatest = std::max(
        greatest,
        bend(a, x, b, unit_or_zero({off[0] - along * chord[0], off[1] - along * chord[1], off[2] - along * chord[2]})));
  }
  return greatest;
}

// From points alone: Gmsh's own curvatures are wrong on the faces of its kernel (0.0037 and 0.028 on a sphere of 1/40).
// Places are between the parameters' bounds, for on them lie the tips, where the normal has no direction.
double curvature_of_face(int face) {
  std::vector<double> low, high, at, on;
  gmsh::model::getParametrizationBounds(2, face, low, high);
  constexpr int grid = samples + 1;
  for (int i = 0; i < grid; ++i)
    for (int j = 0; j < grid; ++j) {
      at.push_back(low[0] + (high[0] - low[0]) * (i + 0.5) / grid);
      at.push_back(low[1] + (high[1] - low[1]) * (j + 0.5) / grid);
    }
  gmsh::model::getValue(2, face, at, on);
  const auto x = [&](int i, int j) { return point_at(on, static_cast<std::size_t>(i * grid + j)); };
  double greatest = 0.0;
  for (int i = 1; i + 1 < grid; ++i)
    for (int j = 1; j + 1 < grid; ++j) {
      const Vec3 normal = unit_or_zero(
          cross(unit_or_zero(minus(x(i + 1, j), x(i - 1, j))), unit_or_zero(minus(x(i, j + 1), x(i, j - 1)))));
      for (const auto& [di, dj] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
        greatest = std::max(greatest, bend(x(i - di, j - dj), x(i, j), x(i + di, j + dj), normal));
    }
  return greatest;
}

double greatest_curvature(int dimension, int tag) {
  std::string type;
  gmsh::model::getType(dimension, tag, type);
  if (type == "Plane" || type == "Line") return 0.0;
  return dimension == 1 ? curvature_of_curve(tag) : curvature_of_face(tag);
}

using Sides = std::map<std::pair<int, int>, double>;  // mm; of each curve and face

// s = h^2 / 8 R: the sagitta s of a side h on a radius R.
Sides sides_for(double sagitta, double extent) {
  Sides sides;
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto& [dimension, tag] : entities) {
    if (dimension != 1 && dimension != 2) continue;
    const double curvature = greatest_curvature(dimension, tag);
    const double side = curvature > 0.0 ? std::sqrt(8.0 * sagitta / curvature) : longest * extent;
    sides[{dimension, tag}] = std::clamp(side, sagitta, longest * extent);
  }
  return sides;
}

void forget_mesh_options() {
  gmsh::model::mesh::removeConstraints();
  for (const char* nothing :
       {"MeshSizeFromCurvature", "MeshSizeExtendFromBoundary", "MeshSizeFromPoints", "MeshSizeFromParametricPoints",
        "MeshSizeMin", "RecombineAll", "SubdivisionAlgorithm", "SecondOrderIncomplete", "Renumber"})
    gmsh::option::setNumber(std::string("Mesh.") + nothing, 0.0);
  gmsh::option::setNumber("Mesh.MeshSizeMax", 1e22);
  gmsh::option::setNumber("Mesh.MeshSizeFactor", 1.0);
  gmsh::option::setNumber("Mesh.ElementOrder", 1.0);
  gmsh::option::setNumber("Mesh.Algorithm", 6.0);  // frontal Delaunay
}

void mesh_with(const Sides& sides, double factor, double least) {
  gmsh::model::mesh::clear();
  gmsh::option::setNumber("Mesh.MeshSizeMin", least);
  gmsh::model::mesh::setSizeCallback([&sides, factor](int dimension, int tag, double, double, double) {
    const auto found = sides.find({dimension, tag});
    return found == sides.end() ? 1e22 : factor * found->second;
  });
  gmsh::model::mesh::generate(2);
  gmsh::model::mesh::removeSizeCallback();
}

// Triangles of a face, its quadrilaterals halved. Gmsh numbers corners before other points, so that of an element of
// second order those alone are taken.
std::vector<std::array<std::size_t, 3>> triangles_of_face(int face, const std::string& file) {
  static const std::map<int, std::pair<int, int>> corners_and_points = {{2, {3, 3}},  {3, {4, 4}},  {9, {3, 6}},
                                                                        {10, {4, 9}}, {16, {4, 8}}, {21, {3, 10}}};
  std::vector<std::array<std::size_t, 3>> result;
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> elements, nodes;
  gmsh::model::mesh::getElements(types, elements, nodes, 2, face);
  for (std::size_t t = 0; t < types.size(); ++t) {
    const auto kind = corners_and_points.find(types[t]);
    if (kind == corners_and_points.end())
      throw InputError(
          fmt::format("{}: Gmsh made elements of its type {} of face {}, which are not read; take the mesh "
                      "options out of the script",
                      file, types[t], face));
    const auto [corners, points] = kind->second;
    for (std::size_t k = 0; k + points <= nodes[t].size(); k += points)
      for (int c = 2; c < corners; ++c) result.push_back({nodes[t][k], nodes[t][k + c - 1], nodes[t][k + c]});
  }
  return result;
}

// Points beside a face and places of its parameters near to them.
struct Probes {
  std::vector<double> point, parameter;
};

// One step of Newton's method without second derivatives towards the nearest places (Gauss-Newton).
void approach_surface(int face, Probes& probes, const std::vector<double>& on) {
  std::vector<double> derivative;
  gmsh::model::getDerivative(2, face, probes.parameter, derivative);
  for (std::size_t k = 0; 6 * k + 5 < derivative.size(); ++k) {
    const Vec3 off = minus(point_at(probes.point, k), point_at(on, k)), du = point_at(derivative, 2 * k),
               dv = point_at(derivative, 2 * k + 1);
    const double uu = dot(du, du), uv = dot(du, dv), vv = dot(dv, dv), determinant = uu * vv - uv * uv;
    if (!(determinant > 1e-9 * uu * vv)) continue;  // a tip, where one direction is lost
    probes.parameter[2 * k] += (vv * dot(off, du) - uv * dot(off, dv)) / determinant;
    probes.parameter[2 * k + 1] += (uu * dot(off, dv) - uv * dot(off, du)) / determinant;
  }
}

double greatest_distance(int face, Probes probes) {
  std::vector<double> least(probes.point.size() / 3, 1e300), on;
  for (int step = 0; step < 3; ++step) {
    gmsh::model::getValue(2, face, probes.parameter, on);
    for (std::size_t k = 0; k < least.size() && 3 * k + 2 < on.size(); ++k) {
      const Vec3 off = minus(point_at(probes.point, k), point_at(on, k));
      least[k] = std::min(least[k], std::sqrt(dot(off, off)));
    }
    approach_surface(face, probes, on);
  }
  return least.empty() ? 0.0 : *std::max_element(least.begin(), least.end());
}

// Distance of the sides' middles and the centres of a face's triangles from it.
double script_face_error(int face, const std::vector<std::array<std::size_t, 3>>& triangles) {
  std::string type;
  gmsh::model::getType(2, face, type);
  if (type == "Plane") return 0.0;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, face, true, true);
  std::unordered_map<std::size_t, std::size_t> place;
  for (std::size_t n = 0; n < tags.size(); ++n) place.emplace(tags[n], n);
  Probes probes;
  const auto mean_of = [&](std::initializer_list<std::size_t> nodes) {
    const auto mean = [&](const std::vector<double>& values, std::size_t size, std::size_t c) {
      double sum = 0.0;
      for (const std::size_t n : nodes) sum += values[size * place.at(n) + c];
      return sum / static_cast<double>(nodes.size());
    };
    for (std::size_t c = 0; c < 3; ++c) probes.point.push_back(mean(coordinates, 3, c));
    for (std::size_t c = 0; c < 2; ++c) probes.parameter.push_back(mean(parameters, 2, c));
  };
  for (const auto& t : triangles) {
    mean_of({t[0], t[1], t[2]});
    for (std::size_t k = 0; k < 3; ++k) mean_of({t[k], t[(k + 1) % 3]});
  }
  return greatest_distance(face, std::move(probes));
}

// Of a border that is not straight, the middle of each chord from the curve.
double curve_error(int curve) {
  std::string type;
  gmsh::model::getType(1, curve, type);
  if (type == "Line") return 0.0;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 1, curve, true, true);
  std::vector<std::pair<double, std::size_t>> along;
  for (std::size_t n = 0; n < parameters.size(); ++n) along.emplace_back(parameters[n], n);
  std::sort(along.begin(), along.end());
  double worst = 0.0;
  for (std::size_t n = 0; n + 1 < along.size(); ++n) {
    std::vector<double> middle;
    gmsh::model::getValue(1, curve, {0.5 * (along[n].first + along[n + 1].first)}, middle);
    const double *a = &coordinates[3 * along[n].second], *b = &coordinates[3 * along[n + 1].second];
    double length = 0.0, part = 0.0, distance = 0.0;
    for (int c = 0; c < 3; ++c) length += (b[c] - a[c]) * (b[c] - a[c]), part += (middle[c] - a[c]) * (b[c] - a[c]);
    part = length > 0.0 ? std::clamp(part / length, 0.0, 1.0) : 0.0;
    for (int c = 0; c < 3; ++c) distance = std::hypot(distance, middle[c] - a[c] - part * (b[c] - a[c]));
    worst = std::max(worst, distance);
  }
  return worst;
}

CadSurface gathered(const std::string& file) {
  CadSurface surface;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, unused;
  gmsh::model::mesh::getNodes(tags, coordinates, unused);
  std::unordered_map<std::size_t, int> index;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    index.emplace(tags[n], static_cast<int>(n));
    surface.list.point.push_back({coordinates[3 * n], coordinates[3 * n + 1], coordinates[3 * n + 2]});
  }
  gmsh::vectorpair faces, curves;
  gmsh::model::getEntities(faces, 2);
  for (const auto& entity : faces) {
    const auto triangles = triangles_of_face(entity.second, file);
    for (const auto& t : triangles) surface.list.triangle.push_back({index.at(t[0]), index.at(t[1]), index.at(t[2])});
    surface.chord_error = std::max(surface.chord_error, script_face_error(entity.second, triangles));
  }
  gmsh::model::getEntities(curves, 1);
  for (const auto& entity : curves) surface.chord_error = std::max(surface.chord_error, curve_error(entity.second));
  return surface;
}

}  // namespace

bool is_all_opencascade() {
  gmsh::vectorpair all, opencascade;
  gmsh::model::getEntities(all, 2);
  gmsh::model::occ::getEntities(opencascade, 2);
  const std::set<std::pair<int, int>> known(opencascade.begin(), opencascade.end());
  return std::all_of(all.begin(), all.end(), [&](const auto& entity) { return known.count(entity) != 0; });
}

CadSurface triangles_of_script(double chord_tolerance, const std::string& file) {
  const double extent = extent_of_model();
  if (!(chord_tolerance >= finest_share * extent))
    throw InputError(
        fmt::format("{}: chord_tolerance = {:.3g} mm is too fine for a part {:.4g} mm across; ask for {:.2g} "
                    "mm or more",
                    file, chord_tolerance, extent, finest_share * extent));
  forget_mesh_options();
  const Sides sides = sides_for(chord_tolerance, extent);
  double factor = 1.0, error = std::numeric_limits<double>::infinity();
  bool obeys = true;  // sizes; lines and faces that the script makes transfinite do not, and cannot be made to
  for (int round = 0; round < most_script_rounds; ++round) {
    guarded_progress(static_cast<double>(round) / most_script_rounds);
    if (obeys)
      mesh_with(sides, factor, 0.1 * chord_tolerance);
    else
      gmsh::model::mesh::refine();
    CadSurface surface = gathered(file);
    if (surface.list.triangle.empty())
      throw InputError(file + ": holds no surface; write the part's faces or solid into it");
    if (surface.chord_error <= chord_tolerance) return surface;
    obeys = obeys && surface.chord_error < 0.9 * error;
    error = surface.chord_error;
    // it goes with the square of the side; a little more than that asks for
    factor *= std::clamp(0.9 * std::sqrt(chord_tolerance / error), 0.25, 0.85);
  }
  throw InputError(fmt::format(
      "{}: triangles come within {:.3g} mm of the surface, not within chord_tolerance = {:.3g} mm; ask for less", file,
      error, chord_tolerance));
}

}  // namespace weaveform
