// The readers of what frames.cpp writes.
#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDataArraySelection.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string>
#include <string_view>

#include "mesher/base/error.hpp"
#include "mesher/base/files.hpp"
#include "mesher/mesh/mesh_format.hpp"
#include "mesher/mesh/vtk_messages.hpp"
#include "solver/result/result.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

InputError not_an_index(const fs::path& file, const std::string& what) {
  return InputError(fmt::format("{}: not an index of frames ({}); solve again", file.string(), what));
}

double time_of(vtkXMLDataElement& entry, const fs::path& file) {
  const char* text = entry.GetAttribute("timestep");
  double time = 0.0;
  const std::string_view digits = text == nullptr ? "" : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), time);
  if (error != std::errc{} || end != digits.data() + digits.size())
    throw not_an_index(file, fmt::format("timestep '{}' is no number", digits));
  return time;
}

InputError not_a_frame(const fs::path& frame, const std::string& what) {
  return InputError(fmt::format("{}: not a Weaveform frame ({}); solve again", frame.string(), what));
}

// Reads the points and the one array asked for ("" for none), in point or cell data.
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const fs::path& frame, const std::string& array) {
  if (!fs::is_regular_file(frame))
    throw FileError(fmt::format("{}: no such frame; solve again, or choose another result folder", frame.string()));
  if (!mesh_format::ends_with_closing_tag(frame)) throw not_a_frame(frame, "damaged or cut short");
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  const VtkMessages complaints;
  reader->SetFileName(frame.c_str());
  reader->UpdateInformation();
  reader->GetPointDataArraySelection()->DisableAllArrays();
  reader->GetCellDataArraySelection()->DisableAllArrays();
  reader->GetPointDataArraySelection()->EnableArray(array.c_str());
  reader->GetCellDataArraySelection()->EnableArray(array.c_str());
  reader->Update();
  if (complaints.count() > 0 || reader->GetErrorCode() != 0) throw not_a_frame(frame, "damaged or cut short");
  return reader->GetOutput();
}

}  // namespace

std::vector<FrameFile> list_frames(const fs::path& directory) {
  const fs::path file = directory / "result.pvd";
  std::istringstream text(read_text_file(file));
  vtkNew<vtkXMLDataParser> parser;
  const VtkMessages complaints;
  parser->SetStream(&text);
  if (parser->Parse() == 0 || complaints.count() > 0) throw not_an_index(file, "the XML is broken");
  vtkXMLDataElement* collection = parser->GetRootElement()->FindNestedElementWithName("Collection");
  if (collection == nullptr) throw not_an_index(file, "no <Collection>");

  std::vector<FrameFile> frames;
  for (int k = 0; k < collection->GetNumberOfNestedElements(); ++k) {
    vtkXMLDataElement& entry = *collection->GetNestedElement(k);
    const char* name = entry.GetAttribute("file");
    if (name == nullptr) throw not_an_index(file, "an entry names no file");
    frames.push_back({time_of(entry, file), directory / name});
  }
  return frames;
}

std::vector<Vec3> read_frame_positions(const fs::path& frame) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(frame, "");
  const auto* points = vtkDoubleArray::SafeDownCast(grid->GetPoints() ? grid->GetPoints()->GetData() : nullptr);
  if (points == nullptr) throw not_a_frame(frame, "its points are not in double precision");
  std::vector<Vec3> position(static_cast<std::size_t>(points->GetNumberOfTuples()));
  for (std::size_t node = 0; node < position.size(); ++node)
    for (int k = 0; k < 3; ++k) position[node][k] = points->GetTypedComponent(static_cast<vtkIdType>(node), k);
  return position;
}

std::vector<double> read_frame_array(const fs::path& frame, const std::string& name) {
  const vtkSmartPointer<vtkUnstructuredGrid> grid = read_grid(frame, name);
  vtkDataArray* array = grid->GetCellData()->GetArray(name.c_str());
  if (array == nullptr) array = grid->GetPointData()->GetArray(name.c_str());
  if (array == nullptr) array = grid->GetFieldData()->GetArray(name.c_str());
  if (array == nullptr) throw not_a_frame(frame, fmt::format("no array '{}'", name));
  const int components = array->GetNumberOfComponents();
  std::vector<double> values(static_cast<std::size_t>(array->GetNumberOfValues()));
  for (std::size_t k = 0; k < values.size(); ++k) {
    const auto index = static_cast<vtkIdType>(k);
    values[k] = array->GetComponent(index / components, static_cast<int>(index % components));
  }
  return values;
}

}  // namespace weaveform
