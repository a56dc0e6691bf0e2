#include <fmt/format.h>
#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "mesher/import/foreign_mesh.hpp"
#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/vtk_messages.hpp"
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
  const VtkMessages quiet;
  std::error_code trouble;
  if (!std::filesystem::is_regular_file(file, trouble) || !mesh_format::ends_with_closing_tag(file))
    throw FileError(fmt::format("{}: not there, not readable, or cut short before </VTKFile>", file.string()));
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkUnstructuredGrid* grid = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || grid == nullptr || grid->GetNumberOfPoints() == 0)
    throw FileError(fmt::format("{}: not a readable .vtu file", file.string()));
  ForeignMesh mesh;
  mesh.file = file.string();
  mesh.position.resize(static_cast<std::size_t>(grid->GetNumberOfPoints()));
  for (std::size_t n = 0; n < mesh.position.size(); ++n) {
    grid->GetPoint(static_cast<vtkIdType>(n), mesh.position[n].data());
    mesh.number.push_back(static_cast<long>(n) + 1);
  }
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c) {
    const int type = grid->GetCellType(c);
    if (type != VTK_TRIANGLE && type != VTK_QUAD) continue;
    ForeignElement shell{static_cast<long>(c) + 1, 0, {}};
    vtkNew<vtkIdList> ids;
    grid->GetCellPoints(c, ids);
    for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k) shell.node.push_back(static_cast<int>(ids->GetId(k)));
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
