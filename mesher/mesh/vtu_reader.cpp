// VTK's part of vtu_grid.hpp; everything here but read_vtu itself runs in the child.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <map>
#include <stdexcept>
#include <system_error>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/guard/guarded.hpp"
#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/vtk_file.hpp"
#include "mesher/mesh/vtk_messages.hpp"
#include "mesher/mesh/vtu_grid.hpp"

namespace weaveform {

namespace {

constexpr double bytes_per_gigabyte = 1073741824.0;

std::optional<VtuType> type_of(vtkDataArray& array) {
  const bool wide = sizeof(long) == 8;
  static const std::map<int, VtuType> types = {{VTK_CHAR, VtuType::int8},
                                               {VTK_SIGNED_CHAR, VtuType::int8},
                                               {VTK_UNSIGNED_CHAR, VtuType::uint8},
                                               {VTK_SHORT, VtuType::int16},
                                               {VTK_UNSIGNED_SHORT, VtuType::uint16},
                                               {VTK_INT, VtuType::int32},
                                               {VTK_UNSIGNED_INT, VtuType::uint32},
                                               {VTK_LONG, wide ? VtuType::int64 : VtuType::int32},
                                               {VTK_UNSIGNED_LONG, wide ? VtuType::uint64 : VtuType::uint32},
                                               {VTK_LONG_LONG, VtuType::int64},
                                               {VTK_UNSIGNED_LONG_LONG, VtuType::uint64},
                                               {VTK_ID_TYPE, sizeof(vtkIdType) == 8 ? VtuType::int64 : VtuType::int32},
                                               {VTK_FLOAT, VtuType::float32},
                                               {VTK_DOUBLE, VtuType::float64}};
  const auto found = types.find(array.GetDataType());
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

// Arrays of numbers; of a name that is there twice, the last is all that VTK keeps.
std::vector<VtuArray> numbers_in(vtkFieldData& data) {
  std::vector<VtuArray> result;
  for (int a = 0; a < data.GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data.GetArray(a);
    const auto type = array == nullptr ? std::nullopt : type_of(*array);
    if (!type || array->GetNumberOfComponents() < 1) continue;
    VtuArray kept{array->GetName() == nullptr ? "" : array->GetName(),
                  *type,
                  array->GetNumberOfComponents(),
                  static_cast<std::size_t>(array->GetNumberOfTuples()),
                  {}};
    const auto* from = static_cast<const char*>(array->GetVoidPointer(0));
    const std::size_t bytes = kept.size() * static_cast<std::size_t>(array->GetDataTypeSize());
    if (bytes > 0) kept.bytes.assign(from, from + bytes);
    result.push_back(std::move(kept));
  }
  return result;
}

void take_points(vtkUnstructuredGrid& from, VtuGrid& grid) {
  if (from.GetPoints() == nullptr) return;
  grid.double_precision = from.GetPoints()->GetDataType() == VTK_DOUBLE;
  grid.point.resize(static_cast<std::size_t>(from.GetNumberOfPoints()));
  for (std::size_t n = 0; n < grid.point.size(); ++n)
    from.GetPoints()->GetPoint(static_cast<vtkIdType>(n), grid.point[n].data());
}

// The arrays as they were read, not by way of cells: their offsets may point anywhere.
void take_cells(vtkUnstructuredGrid& from, VtuGrid& grid) {
  vtkCellArray* cells = from.GetCells();
  vtkUnsignedCharArray* types = from.GetCellTypesArray();
  if (cells == nullptr || types == nullptr || types->GetNumberOfValues() == 0) return;
  vtkDataArray &offset = *cells->GetOffsetsArray(), &node = *cells->GetConnectivityArray();
  if (cells->GetNumberOfCells() != types->GetNumberOfValues())
    throw std::runtime_error("it has other numbers of cells and of their types");
  grid.type.assign(types->GetPointer(0), types->GetPointer(0) + types->GetNumberOfValues());
  grid.offset.clear();
  for (vtkIdType k = 0; k < offset.GetNumberOfValues(); ++k)
    grid.offset.push_back(static_cast<std::int64_t>(offset.GetComponent(k, 0)));
  grid.node.reserve(static_cast<std::size_t>(node.GetNumberOfValues()));
  for (vtkIdType k = 0; k < node.GetNumberOfValues(); ++k)
    grid.node.push_back(static_cast<std::int64_t>(node.GetComponent(k, 0)));
}

void select(vtkDataArraySelection& arrays, const std::vector<std::string>& names) {
  arrays.DisableAllArrays();
  for (const std::string& name : names) arrays.EnableArray(name.c_str());
}

std::string read_with_vtk(const std::filesystem::path& file, const VtuSelection& selection) {
  const VtkMessages complaints;
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->UpdateInformation();
  if (selection) {
    select(*reader->GetPointDataArraySelection(), *selection);
    select(*reader->GetCellDataArraySelection(), *selection);
  }
  reader->Update();
  vtkUnstructuredGrid* read = reader->GetOutput();
  if (complaints.count() > 0 || reader->GetErrorCode() != 0 || read == nullptr)
    throw std::runtime_error("its XML or its arrays are not whole");
  VtuGrid grid;
  take_points(*read, grid);
  take_cells(*read, grid);
  grid.point_data = numbers_in(*read->GetPointData());
  grid.cell_data = numbers_in(*read->GetCellData());
  grid.field_data = numbers_in(*read->GetFieldData());
  return encode_vtu(grid);
}

}  // namespace

VtuGrid read_vtu(const std::filesystem::path& file, const VtuSelection& selection, const std::string& remedy) {
  require_regular_file(file);
  keep_vtk_in_one_thread();
  const auto unreadable = [&](const std::string& what) {
    return FileError(fmt::format("{}: not a readable .vtu file ({}); {}", file.string(), what, remedy));
  };
  if (!mesh_format::ends_with_closing_tag(file)) throw unreadable("it does not end with </VTKFile>: cut short?");
  const double size = static_cast<double>(std::filesystem::file_size(file));
  const Guard guard{.file = file.string(),
                    .what = "VTK's reader",
                    .remedy = remedy,
                    .seconds = 3.0 + size / 5e6,
                    .gigabytes = 1.0 + 32.0 * size / bytes_per_gigabyte};
  const std::string bytes = run_guarded(guard, [&] {
    try {
      return read_with_vtk(file, selection);
    } catch (const std::runtime_error& damage) {
      throw unreadable(damage.what());
    }
  });
  try {
    return decode_vtu(bytes);
  } catch (const std::runtime_error& damage) {
    throw unreadable(damage.what());
  }
}

}  // namespace weaveform
