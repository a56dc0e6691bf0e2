#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mesher/base/error.hpp"
#include "mesher/import/foreign_mesh.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "mesher/tools/triangle_list.hpp"
#include "post/transfer/fibre_field.hpp"

namespace weaveform {

namespace {

using Eigen::Vector3d;

Vector3d vector_of(const Vec3& a) {
  return {a[0], a[1], a[2]};
}
Vec3 array_of(const Vector3d& a) {
  return {a.x(), a.y(), a.z()};
}

// Of quadrilaterals half the cross product of the diagonals, of triangles that of two sides.
Vector3d area_vector(const std::vector<int>& node, const std::vector<Vec3>& position) {
  const auto x = [&](std::size_t k) { return vector_of(position[node[k]]); };
  return 0.5 * (node.size() == 4 ? (x(2) - x(0)).cross(x(3) - x(1)) : (x(1) - x(0)).cross(x(2) - x(0)));
}

// What is interpolated: both directions, area ratio by way of its inverse, thickness, fibre volume.
struct Nodal {
  Vector3d warp = Vector3d::Zero(), weft = Vector3d::Zero();
  double thickness = 0.0, volume = 0.0, mass = 0.0, weight = 0.0;
  void add(const Nodal& other, double w) {
    warp += w * other.warp;
    weft += w * other.weft;
    thickness += w * other.thickness;
    volume += w * other.volume;
    mass += w * other.mass;
    weight += w * other.weight;
  }
};

std::vector<Nodal> nodal_means(const FibreField& fabric) {
  std::vector<Nodal> mean(fabric.position.size());
  for (const auto& element : fabric.element) {
    const FibreState& s = element.state;
    const Nodal here{vector_of(s.warp), vector_of(s.weft), s.thickness, s.fibre_volume_ratio, s.fibre_mass_ratio, 1.0};
    const double area = area_vector(element.node, fabric.position).norm();
    for (const int n : element.node) mean[n].add(here, area);
  }
  for (auto& m : mean) {
    if (m.weight <= 0.0) continue;
    Nodal scaled;
    scaled.add(m, 1.0 / m.weight);
    m = scaled;
  }
  return mean;
}

vtkSmartPointer<vtkPolyData> surface_of(const FibreField& fabric) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& x : fabric.position) points->InsertNextPoint(x.data());
  vtkNew<vtkCellArray> cells;
  for (const auto& element : fabric.element) {
    cells->InsertNextCell(static_cast<int>(element.node.size()));
    for (const int n : element.node) cells->InsertCellPoint(n);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

FibreState turned_into_plane(const Nodal& at, const Vector3d& normal, const std::string& where) {
  FibreState state;
  const auto in_plane = [&](const Vector3d& d) -> Vector3d { return d - d.dot(normal) * normal; };
  const Vector3d warp = in_plane(at.warp), weft = in_plane(at.weft);
  constexpr double least = 1e-3;  // of a unit vector: the element stands across the fabric
  if (warp.norm() < least || weft.norm() < least)
    throw InputError(
        fmt::format("{}: stands across the fabric, so that a yarn direction is its normal; give a mesh of "
                    "the formed surface",
                    where));
  state.warp = array_of(warp.normalized());
  state.weft = array_of(weft.normalized());
  const Vector3d a = warp.normalized(), b = weft.normalized();
  state.shear_angle = std::atan2(a.dot(b), a.cross(b).norm());
  state.thickness = at.thickness;
  state.fibre_volume_ratio = at.volume;
  state.fibre_mass_ratio = at.mass;
  return state;
}

}  // namespace

FibreField map_onto(const FibreField& fabric, const ForeignMesh& structure) {
  const auto surface = surface_of(fabric);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(surface);
  locator->BuildLocator();
  const std::vector<Nodal> mean = nodal_means(fabric);
  FibreField result;
  result.position = structure.position;
  result.flat_thickness = fabric.flat_thickness;
  result.flat_direction = fabric.flat_direction;
  result.source = fabric.source + ", mapped onto " + structure.file;
  vtkNew<vtkGenericCell> cell;
  for (const auto& shell : structure.shells) {
    StateElement element;
    element.number = shell.number;
    element.node = shell.node;
    Vector3d centre = Vector3d::Zero();
    for (const int n : shell.node) centre += vector_of(structure.position[n]) / static_cast<double>(shell.node.size());
    element.centre = array_of(centre);
    double closest[3], squared = 0.0;
    vtkIdType id = -1;
    int sub = 0;
    locator->FindClosestPoint(element.centre.data(), closest, cell, id, sub, squared);
    if (id < 0) throw InputError("the formed fabric has no cells to map from");
    element.distance = std::sqrt(squared);
    double parametric[3], weight[4] = {}, far = 0.0, on_cell[3];
    (void)cell->EvaluatePosition(closest, on_cell, sub, parametric, far, weight);
    Nodal at;
    for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
      at.add(mean[static_cast<std::size_t>(cell->GetPointId(static_cast<int>(k)))], weight[k]);
    const Vector3d normal = area_vector(element.node, structure.position);
    const std::string where = fmt::format("{}:{}: element {}", structure.file, shell.line, shell.number);
    if (!(normal.norm() > 0.0)) throw InputError(where + ": has no area");
    element.state = turned_into_plane(at, normal.normalized(), where);
    result.greatest_distance = std::max(result.greatest_distance, element.distance);
    result.mean_distance += element.distance / static_cast<double>(structure.shells.size());
    result.element.push_back(std::move(element));
  }
  if (result.element.empty())
    throw InputError(fmt::format("{}: no shells (triangles, quadrilaterals) to map onto", structure.file));
  return result;
}

namespace {

ForeignMesh read_vtu_shells(const std::filesystem::path& file) {
  const VtuGrid grid = read_vtu(file, std::vector<std::string>{}, "write it again");
  if (grid.point.empty()) throw FileError(fmt::format("{}: no points in it; write it again", file.string()));
  ForeignMesh mesh;
  mesh.file = file.string();
  mesh.position = grid.point;
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    for (const double x : mesh.position[n])
      if (!(std::abs(x) <= farthest_corner))
        throw InputError(fmt::format("{}: point {} lies at {}; write it again in mm", mesh.file, n, x));
    mesh.number.push_back(static_cast<long>(n) + 1);
  }
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    const std::int64_t nodes = grid.type[c] == VTK_TRIANGLE ? 3 : grid.type[c] == VTK_QUAD ? 4 : 0;
    if (nodes == 0) continue;
    if (grid.offset[c + 1] - grid.offset[c] != nodes)
      throw InputError(fmt::format("{}: cell {} has {} points where its type has {}; write it again", mesh.file, c,
                                   grid.offset[c + 1] - grid.offset[c], nodes));
    ForeignElement shell{static_cast<long>(c) + 1, 0, {}};
    for (std::int64_t k = grid.offset[c]; k < grid.offset[c + 1]; ++k)
      shell.node.push_back(static_cast<int>(grid.node[static_cast<std::size_t>(k)]));
    mesh.shells.push_back(std::move(shell));
  }
  return mesh;
}

}  // namespace

ForeignMesh read_structural_mesh(const std::filesystem::path& file) {
  ForeignMesh mesh = file.extension() == ".vtu" ? read_vtu_shells(file) : read_foreign_mesh(file);
  if (mesh.shells.empty())
    throw InputError(fmt::format("{}: no shells (triangles, quadrilaterals) to map onto", mesh.file));
  return mesh;
}

}  // namespace weaveform
