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

#include "mesher/base/error.hpp"
#include "mesher/base/guarded.hpp"

namespace weaveform {

namespace {

using Point = std::array<double, 3>;

constexpr double finest = 1e-6;   // of the extent; a tolerance that wants more is a slip of the pen
constexpr double longest = 0.25;  // of the extent; a side of nothing that curves
constexpr int most_rounds = 6;
constexpr int samples = 12;  // of curvature along each parameter

double extent_of_model() {
  double low[3], high[3];
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

// At places between the parameters' bounds; a tip, where curvature has no bound, lies on the bounds.
std::vector<double> inner_parameters(int dimension, int tag) {
  std::vector<double> low, high, result;
  gmsh::model::getParametrizationBounds(dimension, tag, low, high);
  const auto at = [&](int c, int k) { return low[c] + (high[c] - low[c]) * (k + 0.5) / samples; };
  for (int i = 0; i < samples; ++i) {
    if (dimension == 1) result.push_back(at(0, i));
    for (int j = 0; dimension == 2 && j < samples; ++j) {
      result.push_back(at(0, i));
      result.push_back(at(1, j));
    }
  }
  return result;
}

double greatest_curvature(int dimension, int tag) {
  std::string type;
  gmsh::model::getType(dimension, tag, type);
  if (type == "Plane" || type == "Line") return 0.0;
  std::vector<double> curvature, other, unused;
  if (dimension == 1)
    gmsh::model::getCurvature(1, tag, inner_parameters(1, tag), curvature);
  else
    gmsh::model::getPrincipalCurvatures(tag, inner_parameters(2, tag), curvature, other, unused, unused);
  double greatest = 0.0;
  for (const auto* values : {&curvature, &other})
    for (const double k : *values)
      if (std::isfinite(k)) greatest = std::max(greatest, std::abs(k));
  return greatest;
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

// Distance of the sides' middles and the centres of a face's triangles from it. The place of a middle's parameters is
// near; where even that is too far, Gmsh looks for the nearest, which takes long.
double face_error(int face, const std::vector<std::array<std::size_t, 3>>& triangles, double enough) {
  std::string type;
  gmsh::model::getType(2, face, type);
  if (type == "Plane") return 0.0;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2, face, true, true);
  std::unordered_map<std::size_t, std::size_t> place;
  for (std::size_t n = 0; n < tags.size(); ++n) place.emplace(tags[n], n);
  std::vector<double> probe, at;
  const auto mean_of = [&](std::initializer_list<std::size_t> nodes) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (const std::size_t n : nodes) sum += coordinates[3 * place.at(n) + c];
      probe.push_back(sum / static_cast<double>(nodes.size()));
    }
    for (std::size_t c = 0; c < 2; ++c) {
      double sum = 0.0;
      for (const std::size_t n : nodes) sum += parameters[2 * place.at(n) + c];
      at.push_back(sum / static_cast<double>(nodes.size()));
    }
  };
  for (const auto& t : triangles) {
    mean_of({t[0], t[1], t[2]});
    for (std::size_t k = 0; k < 3; ++k) mean_of({t[k], t[(k + 1) % 3]});
  }
  std::vector<double> on;
  gmsh::model::getValue(2, face, at, on);
  double worst = 0.0;
  std::vector<double> far;
  for (std::size_t k = 0; k + 2 < probe.size() && k + 2 < on.size(); k += 3) {
    const double distance = std::hypot(probe[k] - on[k], probe[k + 1] - on[k + 1], probe[k + 2] - on[k + 2]);
    if (distance > enough)
      far.insert(far.end(), probe.begin() + static_cast<long>(k), probe.begin() + static_cast<long>(k) + 3);
    else
      worst = std::max(worst, distance);
  }
  if (far.empty()) return worst;
  std::vector<double> nearest, unused;
  gmsh::model::getClosestPoint(2, face, far, nearest, unused);
  for (std::size_t k = 0; k + 2 < far.size() && k + 2 < nearest.size(); k += 3)
    worst = std::max(worst, std::hypot(far[k] - nearest[k], far[k + 1] - nearest[k + 1], far[k + 2] - nearest[k + 2]));
  return worst;
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

CadSurface gathered(const std::string& file, double enough) {
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
    surface.chord_error = std::max(surface.chord_error, face_error(entity.second, triangles, enough));
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
  if (!(chord_tolerance >= finest * extent))
    throw InputError(
        fmt::format("{}: chord_tolerance = {:.3g} mm is too fine for a part {:.4g} mm across; ask for {:.2g} "
                    "mm or more",
                    file, chord_tolerance, extent, finest * extent));
  forget_mesh_options();
  const Sides sides = sides_for(chord_tolerance, extent);
  double error = 0.0, factor = 1.0;
  for (int round = 0; round < most_rounds; ++round) {
    guarded_progress(static_cast<double>(round) / most_rounds);
    mesh_with(sides, factor, 0.1 * chord_tolerance);
    CadSurface surface = gathered(file, chord_tolerance);
    if (surface.list.triangle.empty())
      throw InputError(file + ": holds no surface; write the part's faces or solid into it");
    if (surface.chord_error <= chord_tolerance) return surface;
    // the error goes with the square of the side; a little more than that asks for
    error = surface.chord_error;
    factor *= std::clamp(0.9 * std::sqrt(chord_tolerance / error), 0.25, 0.85);
  }
  throw InputError(fmt::format(
      "{}: triangles come within {:.3g} mm of the surface, not within chord_tolerance = {:.3g} mm; ask for less", file,
      error, chord_tolerance));
}

}  // namespace weaveform
