#include "post/forming/fabric_surface.hpp"

#include <algorithm>

namespace weaveform {

const std::vector<Vec3>& flat_positions(const Mesh& mesh) {
  return mesh.flat_positions();
}

FabricPoint between(const FabricPoint& from, const FabricPoint& to, double t) {
  return {from.place + t * (to.place - from.place), from.flat + t * (to.flat - from.flat),
          from.angle + t * (to.angle - from.angle)};
}

FabricSurface make_surface(const Mesh& mesh, const std::vector<Vec3>& position,
                           const std::vector<double>& shear_angle) {
  FabricSurface surface;
  const std::vector<Vec3>& flat = flat_positions(mesh);
  for (int n = 0; n < mesh.node_count(); ++n)
    surface.point.push_back({vector_of(position[n]), vector_of(flat[n]), 0.0});
  std::vector<double> weight(mesh.node_count(), 0.0);  // mm^2
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    const int centre_number = static_cast<int>(surface.point.size());
    FabricPoint centre{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), shear_angle[c]};
    for (int a = begin; a < end; ++a) {
      const int n = mesh.cells.node[a];
      centre.place += surface.point[n].place / (end - begin);
      centre.flat += surface.point[n].flat / (end - begin);
      surface.point[n].angle += mesh.cells.area[c] * shear_angle[c];
      weight[n] += mesh.cells.area[c];
      surface.triangle.push_back({n, mesh.cells.node[a + 1 < end ? a + 1 : begin], centre_number});
    }
    surface.point.push_back(centre);
  }
  for (int n = 0; n < mesh.node_count(); ++n)
    if (weight[n] > 0.0) surface.point[n].angle /= weight[n];
  return surface;
}

std::optional<FabricPoint> pole_of(const FabricSurface& surface, const PartAxis& axis) {
  const auto cross = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); };
  for (const auto& [i, j, k] : surface.triangle) {
    const FabricPoint &a = surface.point[i], &b = surface.point[j], &c = surface.point[k];
    const Eigen::Vector2d pa = axis.across(a.place), pb = axis.across(b.place), pc = axis.across(c.place);
    const double area = cross(pb - pa, pc - pa);
    if (area == 0.0) continue;
    // barycentric coordinates of the axis; a hair outside still counts, so that none falls between two triangles
    const double wa = cross(pb, pc) / area, wb = cross(pc, pa) / area, wc = 1.0 - wa - wb;
    if (std::min({wa, wb, wc}) < -1e-9) continue;
    return FabricPoint{wa * a.place + wb * b.place + wc * c.place, wa * a.flat + wb * b.flat + wc * c.flat,
                       wa * a.angle + wb * b.angle + wc * c.angle};
  }
  return {};
}

}  // namespace weaveform
