#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/mesh/stack.hpp"
#include "mesher/mesh/vtk_file.hpp"

namespace weaveform {

namespace {

using mesh_format::flat_name;
using mesh_format::ply_name;
using mesh_format::ply_prefix;
using mesh_format::set_prefix;

vtkIdType cell_type(int nodes) {
  if (nodes == 3) return VTK_TRIANGLE;
  return nodes == 4 ? VTK_QUAD : VTK_POLYGON;
}

template <class Array>
vtkSmartPointer<Array> new_array(const std::string& name, int components, std::size_t tuples) {
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(tuples));
  return array;
}

void put_points(const MeshNodes& nodes, vtkUnstructuredGrid& grid) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(nodes.position.size()));
  for (std::size_t n = 0; n < nodes.position.size(); ++n)
    points->SetPoint(static_cast<vtkIdType>(n), nodes.position[n].data());
  grid.SetPoints(points);
}

void put_connectivity(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  const std::size_t yarns = mesh.yarns.node.size();
  const std::size_t cells = mesh.cells.area.size();
  auto type = new_array<vtkUnsignedCharArray>("types", 1, yarns + cells);
  auto offset = new_array<vtkIdTypeArray>("offsets", 1, yarns + cells + 1);
  auto node = new_array<vtkIdTypeArray>("connectivity", 1, 2 * yarns + mesh.cells.node.size());
  for (std::size_t e = 0; e < yarns; ++e) {
    const auto id = static_cast<vtkIdType>(e);
    type->SetValue(id, VTK_LINE);
    offset->SetValue(id, 2 * id);
    node->SetValue(2 * id, mesh.yarns.node[e][0]);
    node->SetValue(2 * id + 1, mesh.yarns.node[e][1]);
  }
  const auto first = static_cast<vtkIdType>(yarns);
  for (std::size_t c = 0; c < cells; ++c) {
    type->SetValue(first + static_cast<vtkIdType>(c),
                   static_cast<unsigned char>(cell_type(mesh.cells.offset[c + 1] - mesh.cells.offset[c])));
    offset->SetValue(first + static_cast<vtkIdType>(c), 2 * first + mesh.cells.offset[c]);
  }
  offset->SetValue(first + static_cast<vtkIdType>(cells), 2 * first + mesh.cells.offset[cells]);
  for (std::size_t k = 0; k < mesh.cells.node.size(); ++k)
    node->SetValue(2 * first + static_cast<vtkIdType>(k), mesh.cells.node[k]);
  vtkNew<vtkCellArray> connectivity;
  connectivity->SetData(offset, node);
  grid.SetCells(type, connectivity);
}

// `value` at grid cell `first` on, 0 elsewhere.
void put_cell_doubles(const std::string& name, const std::vector<double>& value, std::size_t first,
                      vtkUnstructuredGrid& grid) {
  auto array = new_array<vtkDoubleArray>(name, 1, static_cast<std::size_t>(grid.GetNumberOfCells()));
  array->Fill(0.0);
  std::copy(value.begin(), value.end(), array->GetPointer(static_cast<vtkIdType>(first)));
  grid.GetCellData()->AddArray(array);
}

void put_cell_data(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  const std::size_t yarns = mesh.yarns.node.size();
  const auto count = static_cast<std::size_t>(grid.GetNumberOfCells());
  auto family = new_array<vtkUnsignedCharArray>("family", 1, count);
  family->Fill(0);
  for (std::size_t e = 0; e < yarns; ++e)
    family->SetValue(static_cast<vtkIdType>(e), mesh.yarns.family[e] == Family::warp ? 1 : 2);
  grid.GetCellData()->AddArray(family);
  put_cell_doubles("rest_length_mm", mesh.yarns.rest_length, 0, grid);
  put_cell_doubles("section_mm2", mesh.yarns.section, 0, grid);
  put_cell_doubles("yarns", mesh.yarns.yarns, 0, grid);
  put_cell_doubles("jaw_mm", mesh.yarns.jaw, 0, grid);
  put_cell_doubles("softening", mesh.yarns.softening, 0, grid);
  put_cell_doubles("area_mm2", mesh.cells.area, yarns, grid);
  auto lattice = new_array<vtkIntArray>("lattice", 2, count);
  lattice->Fill(0);
  for (std::size_t c = 0; c < mesh.cells.lattice.size(); ++c)
    lattice->SetTypedTuple(static_cast<vtkIdType>(yarns + c), mesh.cells.lattice[c].data());
  grid.GetCellData()->AddArray(lattice);
}

void put_point_data(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  const std::size_t count = mesh.nodes.mass.size();
  auto mass = new_array<vtkDoubleArray>("mass_t", 1, count);
  std::copy(mesh.nodes.mass.begin(), mesh.nodes.mass.end(), mass->GetPointer(0));
  grid.GetPointData()->AddArray(mass);
  auto crossing = new_array<vtkIntArray>("crossing", 2, count);
  for (std::size_t n = 0; n < count; ++n)
    crossing->SetTypedTuple(static_cast<vtkIdType>(n), mesh.nodes.crossing[n].data());
  grid.GetPointData()->AddArray(crossing);
  if (!mesh.nodes.flat_position.empty()) {
    auto flat = new_array<vtkDoubleArray>(flat_name, 3, count);
    for (std::size_t n = 0; n < count; ++n)
      flat->SetTypedTuple(static_cast<vtkIdType>(n), mesh.nodes.flat_position[n].data());
    grid.GetPointData()->AddArray(flat);
  }
  for (const auto& set : mesh.sets) {
    auto member = new_array<vtkUnsignedCharArray>(set_prefix + set.name, 1, count);
    member->Fill(0);
    for (const int n : set.node) member->SetValue(n, 1);
    grid.GetPointData()->AddArray(member);
  }
}

void put_field_data(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  auto spacing = new_array<vtkDoubleArray>("spacing_mm", 2, 1);
  spacing->SetTypedTuple(0, mesh.spacing.data());
  auto size = new_array<vtkIntArray>("lattice_size", 2, 1);
  size->SetTypedTuple(0, mesh.lattice_size.data());
  auto thickness = new_array<vtkDoubleArray>("thickness_mm", 1, 1);
  thickness->SetValue(0, mesh.thickness);
  auto coefficient = new_array<vtkDoubleArray>("coefficient_per_mm", 2, mesh.cells.coefficient.size());
  for (std::size_t k = 0; k < mesh.cells.coefficient.size(); ++k)
    coefficient->SetTypedTuple(static_cast<vtkIdType>(k), mesh.cells.coefficient[k].data());
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{spacing, size, thickness, coefficient})
    grid.GetFieldData()->AddArray(array);
}

void put_ties(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  auto corner = new_array<vtkIntArray>("frame_corner", 4, 1);
  corner->SetTypedTuple(0, mesh.frame.corner.data());
  auto node = new_array<vtkIntArray>("tie_node", 3, mesh.tie.size());
  auto share = new_array<vtkDoubleArray>("tie_share", 1, mesh.tie.size());
  for (std::size_t k = 0; k < mesh.tie.size(); ++k) {
    const auto& tie = mesh.tie[k];
    const int nodes[3] = {tie.node, tie.to[0], tie.to[1]};
    node->SetTypedTuple(static_cast<vtkIdType>(k), nodes);
    share->SetValue(static_cast<vtkIdType>(k), tie.share);
  }
  auto count = new_array<vtkIntArray>("tie_count", 1, 1);
  count->SetValue(0, static_cast<int>(mesh.tie.size()));
  grid.GetFieldData()->AddArray(corner);
  grid.GetFieldData()->AddArray(count);
  if (mesh.tie.empty()) return;  // meshio reads no empty array
  grid.GetFieldData()->AddArray(node);
  grid.GetFieldData()->AddArray(share);
}

vtkSmartPointer<vtkIntArray> integers(const std::string& name, const std::vector<int>& value) {
  auto array = new_array<vtkIntArray>(name, 1, value.size());
  std::copy(value.begin(), value.end(), array->GetPointer(0));
  return array;
}

void put_frames(const std::vector<MeshPly>& plies, vtkUnstructuredGrid& grid) {
  if (std::none_of(plies.begin(), plies.end(), [](const MeshPly& ply) { return ply.frame.present(); })) return;
  auto corner = new_array<vtkIntArray>("plies_frame_corner", 4, plies.size());
  for (std::size_t k = 0; k < plies.size(); ++k)
    corner->SetTypedTuple(static_cast<vtkIdType>(k), plies[k].frame.corner.data());
  grid.GetFieldData()->AddArray(corner);
}

void put_plies(const Mesh& mesh, vtkUnstructuredGrid& grid) {
  if (mesh.ply.empty()) return;
  std::vector<int> on_elements = ply_of_yarns(mesh);
  const std::vector<int> on_cells = ply_of_cells(mesh);
  on_elements.insert(on_elements.end(), on_cells.begin(), on_cells.end());
  grid.GetCellData()->AddArray(integers(ply_name, on_elements));
  grid.GetPointData()->AddArray(integers(ply_name, ply_of_nodes(mesh)));
  const std::size_t count = mesh.ply.size();
  auto first = new_array<vtkIntArray>("plies_first", 5, count);
  auto spacing = new_array<vtkDoubleArray>("plies_spacing_mm", 2, count);
  auto size = new_array<vtkIntArray>("plies_lattice_size", 2, count);
  auto thickness = new_array<vtkDoubleArray>("plies_thickness_mm", 1, count);
  for (std::size_t k = 0; k < count; ++k) {
    const MeshPly& ply = mesh.ply[k];
    const auto id = static_cast<vtkIdType>(k);
    const std::array<int, 5> begins = {ply.first_node, ply.first_yarn, ply.first_cell, ply.first_tie, ply.first_row};
    first->SetTypedTuple(id, begins.data());
    spacing->SetTypedTuple(id, ply.spacing.data());
    size->SetTypedTuple(id, ply.lattice_size.data());
    thickness->SetValue(id, ply.thickness);
  }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{first, spacing, size, thickness})
    grid.GetFieldData()->AddArray(array);
  put_frames(mesh.ply, grid);
  for (std::size_t k = 0; k < count; ++k)  // names as arrays, for meshio reads no texts
    grid.GetFieldData()->AddArray(integers(ply_prefix + mesh.ply[k].name, {static_cast<int>(k)}));
}

}  // namespace

void write_mesh(const Mesh& mesh, const std::filesystem::path& file) {
  const auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  put_points(mesh.nodes, *grid);
  put_connectivity(mesh, *grid);
  put_cell_data(mesh, *grid);
  put_point_data(mesh, *grid);
  put_field_data(mesh, *grid);
  put_ties(mesh, *grid);
  put_plies(mesh, *grid);

  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk_whole(file, *writer);
}

}  // namespace weaveform
