#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"
#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/mesh_io.hpp"

namespace weaveform {

namespace {

using mesh_format::ErrorListener;
using mesh_format::flat_name;
using mesh_format::set_prefix;
using Grid = vtkSmartPointer<vtkUnstructuredGrid>;

// Collects what a file lacks, so that it can be said all at once.
struct Wanted {
  std::filesystem::path file;
  std::vector<std::string> complaints;

  void complain(const std::string& what) {
    complaints.push_back(fmt::format("{}: {}; write the mesh again with 'weaveform mesh'", file.string(), what));
  }
  // The array of that name, type and shape; null (and a complaint) when there is none.
  template <class Array>
  Array* array(vtkFieldData* data, const std::string& name, int components, std::size_t tuples) {
    auto* found = Array::SafeDownCast(data->GetAbstractArray(name.c_str()));
    if (found == nullptr || found->GetNumberOfComponents() != components ||
        found->GetNumberOfTuples() != static_cast<vtkIdType>(tuples)) {
      complain(
          fmt::format("not a Weaveform mesh: array '{}' with {} tuples of {} is missing", name, tuples, components));
      return nullptr;
    }
    return found;
  }
  void stop_if_any() const {
    if (!complaints.empty()) throw InputError(complaints);
  }
};

FileError unreadable(const std::filesystem::path& file) {
  return FileError(
      fmt::format("{}: not a readable .vtu file, or cut short; make it again with 'weaveform mesh'", file.string()));
}

Grid read_grid(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw FileError(fmt::format("{}: no such file; make it with 'weaveform mesh'", file.string()));
  require_regular_file(file);
  // asked first: of a file cut short VTK takes the sizes of arrays from whatever it finds, and the memory for them
  if (!mesh_format::ends_with_closing_tag(file)) throw unreadable(file);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  const ErrorListener errors(reader);
  vtkNew<vtkCallbackCommand> silent;  // the XML parser's own complaints, which end in the reader's error
  silent->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  reader->SetParserErrorObserver(silent);
  reader->SetFileName(file.c_str());
  reader->Update();
  Grid grid = reader->GetOutput();
  if (errors.heard() || reader->GetErrorCode() != 0 || grid == nullptr) throw unreadable(file);
  return grid;
}

void get_cell_doubles(Wanted& wanted, vtkUnstructuredGrid& grid, const std::string& name, std::size_t first,
                      std::size_t count, std::vector<double>& value) {
  const auto* array =
      wanted.array<vtkDoubleArray>(grid.GetCellData(), name, 1, static_cast<std::size_t>(grid.GetNumberOfCells()));
  if (array == nullptr) return;
  auto* from = const_cast<vtkDoubleArray*>(array)->GetPointer(static_cast<vtkIdType>(first));
  value.assign(from, from + count);
}

// Pairs of a two-component array, from tuple `first` on.
template <class Array, class Value>
void get_pairs(Array* array, std::size_t first, std::size_t count, std::vector<std::array<Value, 2>>& value) {
  if (array == nullptr) return;
  value.resize(count);
  for (std::size_t k = 0; k < count; ++k) array->GetTypedTuple(static_cast<vtkIdType>(first + k), value[k].data());
}

// Yarn elements come first; their number.
std::size_t count_yarns(Wanted& wanted, vtkUnstructuredGrid& grid) {
  const auto count = static_cast<std::size_t>(grid.GetNumberOfCells());
  auto* family = wanted.array<vtkUnsignedCharArray>(grid.GetCellData(), "family", 1, count);
  wanted.stop_if_any();
  std::size_t yarns = 0;
  while (yarns < count && family->GetValue(static_cast<vtkIdType>(yarns)) != 0) ++yarns;
  for (std::size_t c = 0; c < count; ++c) {
    const bool line = grid.GetCellType(static_cast<vtkIdType>(c)) == VTK_LINE;
    const int value = family->GetValue(static_cast<vtkIdType>(c));
    if (line == (c < yarns) && (value != 0) == (c < yarns) && value <= 2) continue;
    wanted.complain(
        fmt::format("not a Weaveform mesh: cell {} has family {} and is {}a line", c, value, line ? "" : "not "));
    wanted.stop_if_any();
  }
  return yarns;
}

void get_connectivity(Wanted& wanted, vtkUnstructuredGrid& grid, std::size_t yarns, Mesh& mesh) {
  const auto count = static_cast<std::size_t>(grid.GetNumberOfCells());
  const vtkIdType points = grid.GetNumberOfPoints();
  mesh.cells.offset.reserve(count - yarns + 1);
  for (std::size_t c = 0; c < count; ++c) {
    vtkIdType size = 0;
    const vtkIdType* node = nullptr;
    grid.GetCells()->GetCellAtId(static_cast<vtkIdType>(c), size, node);
    if ((c < yarns) != (size == 2) || size < 2 ||
        std::any_of(node, node + size, [&](vtkIdType n) { return n < 0 || n >= points; })) {
      wanted.complain(fmt::format("cell {} has {} nodes or names a point that is not there", c, size));
      wanted.stop_if_any();
    }
    if (c < yarns) {
      mesh.yarns.node.push_back({static_cast<int>(node[0]), static_cast<int>(node[1])});
    } else {
      for (vtkIdType k = 0; k < size; ++k) mesh.cells.node.push_back(static_cast<int>(node[k]));
      mesh.cells.offset.push_back(static_cast<int>(mesh.cells.node.size()));
    }
  }
}

void get_cell_data(Wanted& wanted, vtkUnstructuredGrid& grid, std::size_t yarns, Mesh& mesh) {
  const auto count = static_cast<std::size_t>(grid.GetNumberOfCells());
  auto* family = wanted.array<vtkUnsignedCharArray>(grid.GetCellData(), "family", 1, count);
  for (std::size_t e = 0; e < yarns; ++e)
    mesh.yarns.family.push_back(family->GetValue(static_cast<vtkIdType>(e)) == 1 ? Family::warp : Family::weft);
  get_cell_doubles(wanted, grid, "rest_length_mm", 0, yarns, mesh.yarns.rest_length);
  get_cell_doubles(wanted, grid, "section_mm2", 0, yarns, mesh.yarns.section);
  get_cell_doubles(wanted, grid, "yarns", 0, yarns, mesh.yarns.yarns);
  get_cell_doubles(wanted, grid, "jaw_mm", 0, yarns, mesh.yarns.jaw);
  get_cell_doubles(wanted, grid, "softening", 0, yarns, mesh.yarns.softening);
  get_cell_doubles(wanted, grid, "area_mm2", yarns, count - yarns, mesh.cells.area);
  get_pairs(wanted.array<vtkIntArray>(grid.GetCellData(), "lattice", 2, count), yarns, count - yarns,
            mesh.cells.lattice);
}

void get_nodes(Wanted& wanted, vtkUnstructuredGrid& grid, Mesh& mesh) {
  const auto count = static_cast<std::size_t>(grid.GetNumberOfPoints());
  mesh.nodes.position.resize(count);
  for (std::size_t n = 0; n < count; ++n) grid.GetPoint(static_cast<vtkIdType>(n), mesh.nodes.position[n].data());
  if (auto* mass = wanted.array<vtkDoubleArray>(grid.GetPointData(), "mass_t", 1, count))
    mesh.nodes.mass.assign(mass->GetPointer(0), mass->GetPointer(0) + count);
  get_pairs(wanted.array<vtkIntArray>(grid.GetPointData(), "crossing", 2, count), 0, count, mesh.nodes.crossing);
  if (grid.GetPointData()->HasArray(flat_name.c_str()) != 0) {
    if (auto* flat = wanted.array<vtkDoubleArray>(grid.GetPointData(), flat_name, 3, count)) {
      mesh.nodes.flat_position.resize(count);
      for (std::size_t n = 0; n < count; ++n)
        flat->GetTypedTuple(static_cast<vtkIdType>(n), mesh.nodes.flat_position[n].data());
    }
  }
  for (int a = 0; a < grid.GetPointData()->GetNumberOfArrays(); ++a) {
    const char* text = grid.GetPointData()->GetArrayName(a);
    const std::string name = text == nullptr ? "" : text;
    if (name.rfind(set_prefix, 0) != 0) continue;
    const auto* member = wanted.array<vtkUnsignedCharArray>(grid.GetPointData(), name, 1, count);
    if (member == nullptr) continue;
    NodeSet set{name.substr(set_prefix.size()), {}};
    for (std::size_t n = 0; n < count; ++n)
      if (member->GetValue(static_cast<vtkIdType>(n)) != 0) set.node.push_back(static_cast<int>(n));
    mesh.sets.push_back(std::move(set));
  }
}

void get_field_data(Wanted& wanted, vtkUnstructuredGrid& grid, Mesh& mesh) {
  vtkFieldData* data = grid.GetFieldData();
  if (auto* spacing = wanted.array<vtkDoubleArray>(data, "spacing_mm", 2, 1))
    spacing->GetTypedTuple(0, mesh.spacing.data());
  if (auto* size = wanted.array<vtkIntArray>(data, "lattice_size", 2, 1))
    size->GetTypedTuple(0, mesh.lattice_size.data());
  if (auto* thickness = wanted.array<vtkDoubleArray>(data, "thickness_mm", 1, 1))
    mesh.thickness = thickness->GetValue(0);
  const std::size_t entries = mesh.cells.node.size();
  get_pairs(wanted.array<vtkDoubleArray>(data, "coefficient_per_mm", 2, entries), 0, entries, mesh.cells.coefficient);
}

// Lattice indices outside the lattice would send the solver out of its arrays.
void check_crossings(Wanted& wanted, const Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.nodes.crossing.size(); ++n) {
    const auto& [i, j] = mesh.nodes.crossing[n];
    if (i == -1 && j == -1) continue;
    if (i >= 0 && j >= 0 && i < mesh.lattice_size[0] && j < mesh.lattice_size[1]) continue;
    wanted.complain(fmt::format("node {} lies at crossing ({}, {}) of a lattice of {} x {}", n, i, j,
                                mesh.lattice_size[0], mesh.lattice_size[1]));
    return;
  }
}

}  // namespace

namespace {

void get_ties(Wanted& wanted, vtkUnstructuredGrid& grid, Mesh& mesh) {
  auto* corner = wanted.array<vtkIntArray>(grid.GetFieldData(), "frame_corner", 4, 1);
  auto* any = grid.GetFieldData()->GetAbstractArray("tie_node");
  const auto ties = any == nullptr ? 0 : static_cast<std::size_t>(any->GetNumberOfTuples());
  auto* node = wanted.array<vtkIntArray>(grid.GetFieldData(), "tie_node", 3, ties);
  auto* share = wanted.array<vtkDoubleArray>(grid.GetFieldData(), "tie_share", 1, ties);
  wanted.stop_if_any();
  corner->GetTypedTuple(0, mesh.frame.corner.data());
  const vtkIdType points = grid.GetNumberOfPoints();
  const auto valid = [points](int n) { return n >= 0 && n < points; };
  bool all_valid = !mesh.frame.present() || std::all_of(mesh.frame.corner.begin(), mesh.frame.corner.end(), valid);
  for (std::size_t k = 0; k < ties; ++k) {
    int nodes[3] = {0, 0, 0};
    node->GetTypedTuple(static_cast<vtkIdType>(k), nodes);
    all_valid = all_valid && valid(nodes[0]) && valid(nodes[1]) && valid(nodes[2]);
    mesh.tie.push_back({nodes[0], {nodes[1], nodes[2]}, share->GetValue(static_cast<vtkIdType>(k))});
  }
  if (!all_valid) wanted.complain("a tie or the shear frame names a point that is not there");
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& file) {
  const Grid grid = read_grid(file);
  Wanted wanted{file, {}};
  Mesh mesh;
  const std::size_t yarns = count_yarns(wanted, *grid);
  get_connectivity(wanted, *grid, yarns, mesh);
  get_cell_data(wanted, *grid, yarns, mesh);
  get_nodes(wanted, *grid, mesh);
  get_field_data(wanted, *grid, mesh);
  get_ties(wanted, *grid, mesh);
  wanted.stop_if_any();
  check_crossings(wanted, mesh);
  wanted.stop_if_any();
  return mesh;
}

}  // namespace weaveform
