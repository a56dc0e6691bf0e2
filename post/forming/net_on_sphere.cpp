#include "post/forming/net_on_sphere.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/drape/sphere_net.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

int sphere_of(const Scene& scene, const std::vector<PlacedTool>& tools) {
  int sphere = -1;
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (tools[t].tool.shape != ToolShape::sphere) continue;
    if (scene.tools[t].travel != 0.0) return static_cast<int>(t);
    if (sphere < 0) sphere = static_cast<int>(t);
  }
  return sphere;
}

// The sphere's own axis, so that the pole is its lowest point.
PartAxis axis_of(const PlacedTool& sphere) {
  const auto& a = sphere.place.axis;
  PartAxis axis;
  axis.origin = vector_of(sphere.place.origin);
  axis.up = vector_of(a);
  axis.warp = axis.up.unitOrthogonal();
  axis.weft = axis.up.cross(axis.warp);
  return axis;
}

// On the flat blank; the foot of the sphere's centre where no fabric lies over its axis.
Vector3d flat_pole(const Scene& scene, const Mesh& mesh, const Fields& fields, const PlacedTool& sphere) {
  const FabricSurface surface = make_surface(mesh, fields.position, fields.shear_angle);
  if (const auto pole = pole_of(surface, axis_of(sphere))) return pole->flat;
  return {sphere.place.origin[0], sphere.place.origin[1], scene.blank.position[2]};
}

bool lies_on(const PlacedTool& sphere, const Vector3d& x, double tolerance) {
  const double along = (x - vector_of(sphere.place.origin)).dot(vector_of(sphere.place.axis));
  return along <= 0.0 && gap_to(sphere, x).gap <= tolerance;  // beyond 0 there is the shank
}

void sum_up(const Mesh& mesh, SphereNetFit& fit) {
  struct Sum {
    double area = 0.0, square = 0.0;
  };
  Sum all;
  std::vector<Sum> bin;
  for (std::size_t c = 0; c < fit.cell.size(); ++c) {
    const SphereNetCell& cell = fit.cell[c];
    if (!cell.on_sphere || std::isnan(cell.net)) continue;
    ++fit.cells;
    const double difference = cell.angle - cell.net, area = mesh.cells.area[c];
    const auto b = static_cast<std::size_t>(std::abs(cell.s) / bin_width);
    if (b >= bin.size()) bin.resize(b + 1);
    for (Sum* sum : {&all, &bin[b]}) {
      sum->area += area;
      sum->square += area * difference * difference;
    }
    fit.greatest = std::max(fit.greatest, std::abs(difference));
    fit.greatest_s = std::max(fit.greatest_s, std::abs(cell.s));
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  fit.rms = fit.cells > 0 ? std::sqrt(all.square / all.area) : none;
  if (fit.cells == 0) fit.greatest = none;
  const double limit = holds_within * std::numbers::pi / 180.0;
  const auto lost =
      std::find_if(bin.begin(), bin.end(), [&](const Sum& sum) { return sum.square > limit * limit * sum.area; });
  fit.holds_to = std::min(fit.greatest_s, bin_width * static_cast<double>(lost - bin.begin()));
}

}  // namespace

std::optional<SphereNetFit> compare_with_sphere_net(const Scene& scene, const Mesh& mesh, const Fields& fields,
                                                    const std::vector<PlacedTool>& tools) {
  const int number = sphere_of(scene, tools);
  if (number < 0) return {};
  const PlacedTool& sphere = tools[number];
  SphereNetFit fit;
  fit.tool = sphere.tool.name;
  fit.radius = sphere.tool.radius + sphere.tool.offset;
  const Vector3d pole = flat_pole(scene, mesh, fields, sphere);
  const Vector3d warp = flat_warp(scene.blank), weft = flat_weft(scene.blank);
  const double fold = sphere_net_end(), tolerance = contact_tolerance * mesh.thickness;
  const std::vector<Vec3>& flat = flat_positions(mesh);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
    Vector3d centre = Vector3d::Zero();
    SphereNetCell cell;
    cell.on_sphere = true;
    for (int a = begin; a < end; ++a) {
      centre += vector_of(flat[mesh.cells.node[a]]) / (end - begin);
      cell.on_sphere = cell.on_sphere && lies_on(sphere, vector_of(fields.position[mesh.cells.node[a]]), tolerance);
    }
    cell.u = (centre - pole).dot(warp);
    cell.v = (centre - pole).dot(weft);
    cell.s = cell.u * cell.v / (fit.radius * fit.radius);
    cell.angle = fields.shear_angle[c];
    cell.net = std::abs(cell.s) <= fold ? sphere_net_angle(cell.s) : std::numeric_limits<double>::quiet_NaN();
    fit.cell.push_back(cell);
  }
  sum_up(mesh, fit);
  return fit;
}

}  // namespace weaveform
