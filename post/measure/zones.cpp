#include "post/measure/zones.hpp"

#include <cmath>
#include <limits>

#include "core/vector/vector.hpp"
#include "solver/result/probe.hpp"

namespace weaveform {

namespace {

// Every node, drawn towards the cell's centre by 1e-6 so that a cell that only touches a line is not cut by it, lies in
// the same zone as the centre; else the cell is a straddling one.
Zone zone_of_polygon(const BiasSpecimen& specimen, const std::vector<Vec2>& corner) {
  Vec2 centre = {0.0, 0.0};
  for (const Vec2& p : corner)
    for (int k = 0; k < 2; ++k) centre[k] += p[k] / static_cast<double>(corner.size());
  const int along = specimen.axis, across = 1 - along;
  const Zone zone = zone_of_point(specimen, centre[across], centre[along]);
  constexpr double shrink = 1e-6;
  for (const Vec2& p : corner) {
    const Vec2 inner = {p[0] + shrink * (centre[0] - p[0]), p[1] + shrink * (centre[1] - p[1])};
    if (zone_of_point(specimen, inner[across], inner[along]) != zone) return Zone::straddling;
  }
  return zone;
}

}  // namespace

Zone zone_of_point(const BiasSpecimen& specimen, double across, double along) {
  // Distances along the yarns' bisectors: a yarn of one family keeps along - across, one of the other along + across.
  // It meets no grip when that stays below half the free length.
  const double half = 0.5 * specimen.free_length();
  const bool first_free = std::abs(along - across) < half;
  const bool second_free = std::abs(along + across) < half;
  if (first_free && second_free) return Zone::a;
  return first_free || second_free ? Zone::b : Zone::c;
}

std::vector<Zone> zones_of_cells(const Mesh& mesh, const BlankSpec& blank, const BiasSpecimen& specimen) {
  std::vector<Zone> zone(mesh.cells.size());
  std::vector<Vec2> corner;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    corner.clear();
    for (int entry = mesh.cells.offset[cell]; entry < mesh.cells.offset[cell + 1]; ++entry)
      corner.push_back(blank_coordinates(blank, mesh.flat_positions()[mesh.cells.node[entry]]));
    zone[cell] = zone_of_polygon(specimen, corner);
  }
  return zone;
}

std::array<ZoneAngle, 3> angles_by_zone(const MeshCells& cells, const std::vector<Zone>& zone,
                                        const std::vector<double>& shear_angle) {
  std::array<ZoneAngle, 3> result;
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (zone[cell] == Zone::straddling) continue;
    ZoneAngle& z = result[static_cast<std::size_t>(zone[cell])];
    ++z.cells;
    z.area += cells.area[cell];
    z.mean += cells.area[cell] * shear_angle[cell];
  }
  for (ZoneAngle& z : result) z.mean = z.cells > 0 ? z.mean / z.area : std::numeric_limits<double>::quiet_NaN();
  // Second pass: the difference of two large sums would lose the digits of a small scatter.
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (zone[cell] == Zone::straddling) continue;
    ZoneAngle& z = result[static_cast<std::size_t>(zone[cell])];
    z.sd += cells.area[cell] * (shear_angle[cell] - z.mean) * (shear_angle[cell] - z.mean);
  }
  for (ZoneAngle& z : result) z.sd = z.cells > 0 ? std::sqrt(z.sd / z.area) : z.mean;
  return result;
}

}  // namespace weaveform
