#include "post/output/contours.hpp"

#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkCellDataToPointData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/vector/angle.hpp"
#include "mesher/mesh/vtk_file.hpp"
#include "mesher/mesh/vtk_messages.hpp"

namespace weaveform {

namespace {

constexpr const char* angle_name = "shear_angle_deg";

vtkSmartPointer<vtkPoints> double_points(const std::vector<Vec3>& position) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(position.size()));
  for (std::size_t k = 0; k < position.size(); ++k) points->SetPoint(static_cast<vtkIdType>(k), position[k].data());
  return points;
}

// The cells at their current positions with their angle (deg) as cell data.
vtkSmartPointer<vtkPolyData> sheared_surface(const Mesh& mesh, const Fields& fields) {
  vtkNew<vtkCellArray> polygons;
  vtkNew<vtkDoubleArray> angle;
  angle->SetName(angle_name);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int begin = mesh.cells.offset[cell], nodes = mesh.cells.offset[cell + 1] - begin;
    polygons->InsertNextCell(nodes);
    for (int k = 0; k < nodes; ++k) polygons->InsertCellPoint(mesh.cells.node[begin + k]);
    angle->InsertNextValue(fields.shear_angle[cell] * degrees_per_radian);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(double_points(fields.position));
  surface->SetPolys(polygons);
  surface->GetCellData()->SetScalars(angle);
  return surface;
}

// Multiples of the step inside the range of the cells' angles, without zero.
std::vector<double> levels_within(const std::vector<double>& shear_angle, double step) {
  std::vector<double> levels;
  if (shear_angle.empty()) return levels;
  const auto [least, greatest] = std::minmax_element(shear_angle.begin(), shear_angle.end());
  const double first = std::ceil(*least * degrees_per_radian / step);
  const double last = std::floor(*greatest * degrees_per_radian / step);
  if (!(last - first < 1000.0))
    throw InputError(
        fmt::format("output.contour_step: {} deg gives more than 1000 isolines; choose a greater step", step));
  for (double multiple = first; multiple <= last; multiple += 1.0)
    if (multiple != 0.0) levels.push_back(multiple * step);
  return levels;
}

using Segment = std::array<vtkIdType, 2>;

std::vector<Segment> segments_of(vtkPolyData& lines) {
  std::vector<Segment> segments;
  const auto iterator = vtk::TakeSmartPointer(lines.GetLines()->NewIterator());
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell()) {
    vtkIdType count = 0;
    const vtkIdType* id = nullptr;
    iterator->GetCurrentCell(count, id);
    if (count == 2 && id[0] != id[1]) segments.push_back({id[0], id[1]});
  }
  return segments;
}

// Chains of point ids made of segments end to end: open chains first, each from one of its ends, then closed ones,
// whose first point stands at the end again. (vtkStripper joins in one direction only and leaves the lines in pieces.)
std::vector<std::vector<vtkIdType>> join(const std::vector<Segment>& segments, vtkIdType points) {
  std::vector<std::vector<std::size_t>> at(static_cast<std::size_t>(points));  // segments at each point
  for (std::size_t s = 0; s < segments.size(); ++s)
    for (const vtkIdType id : segments[s]) at[static_cast<std::size_t>(id)].push_back(s);
  std::vector<bool> used(segments.size(), false);
  std::vector<std::vector<vtkIdType>> chains;
  const auto walk = [&](vtkIdType from, std::size_t segment) {
    std::vector<vtkIdType> chain = {from};
    for (bool further = true; further;) {
      used[segment] = true;
      const vtkIdType to = segments[segment][segments[segment][0] == chain.back() ? 1 : 0];
      chain.push_back(to);
      const auto& next = at[static_cast<std::size_t>(to)];
      const auto unused = std::find_if(next.begin(), next.end(), [&](std::size_t s) { return !used[s]; });
      further = next.size() == 2 && unused != next.end();
      if (further) segment = *unused;
    }
    chains.push_back(std::move(chain));
  };
  for (vtkIdType id = 0; id < points; ++id) {
    const auto& here = at[static_cast<std::size_t>(id)];
    for (const std::size_t s : here)
      if (here.size() != 2 && !used[s]) walk(id, s);
  }
  for (std::size_t s = 0; s < segments.size(); ++s)
    if (!used[s]) walk(segments[s][0], s);
  return chains;
}

}  // namespace

std::vector<Isoline> shear_angle_isolines(const Mesh& mesh, const Fields& fields, double step) {
  const std::vector<double> levels = levels_within(fields.shear_angle, step);
  if (levels.empty()) return {};
  vtkNew<vtkCellDataToPointData> to_points;
  to_points->SetInputData(sheared_surface(mesh, fields));
  vtkNew<vtkContourFilter> contour;
  contour->SetInputConnection(to_points->GetOutputPort());
  contour->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  contour->UseScalarTreeOn();
  for (std::size_t k = 0; k < levels.size(); ++k) contour->SetValue(static_cast<int>(k), levels[k]);
  contour->Update();
  vtkPolyData& cut = *contour->GetOutput();
  vtkDataArray* angle = cut.GetPointData()->GetArray(angle_name);
  if (angle == nullptr) return {};

  // The filter cuts one segment per cell; joined they make the isolines.
  std::vector<Isoline> isolines;
  for (const std::vector<vtkIdType>& chain : join(segments_of(cut), cut.GetNumberOfPoints())) {
    // The filter interpolates the angle too, so the level comes back with rounding: take the multiple it stands for.
    Isoline isoline{std::round(angle->GetTuple1(chain.front()) / step) * step, {}, 0};
    for (const vtkIdType id : chain) cut.GetPoint(id, isoline.point.emplace_back().data());
    isolines.push_back(std::move(isoline));
  }
  return isolines;
}

void write_contours(const std::vector<Isoline>& isolines, const std::filesystem::path& file, bool of_stack) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> level;
  level->SetName(angle_name);
  vtkNew<vtkIntArray> ply;
  ply->SetName("ply");
  for (const Isoline& isoline : isolines) {
    lines->InsertNextCell(static_cast<int>(isoline.point.size()));
    for (const Vec3& p : isoline.point) lines->InsertCellPoint(points->InsertNextPoint(p.data()));
    level->InsertNextValue(isoline.level);
    ply->InsertNextValue(isoline.ply);
  }
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->SetScalars(level);
  if (of_stack) data->GetCellData()->AddArray(ply);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  write_vtk_whole(file, *writer);
}

std::vector<Isoline> read_contours(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file))
    throw FileError(fmt::format("{}: no such file; run 'weaveform post' first", file.string()));
  const VtkMessages complaints;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData& lines = *reader->GetOutput();
  vtkDataArray* level = lines.GetCellData()->GetArray(angle_name);
  const bool whole = level != nullptr && level->GetNumberOfTuples() == lines.GetNumberOfLines();
  if (complaints.count() > 0 || reader->GetErrorCode() != 0 || !whole)
    throw InputError(fmt::format("{}: not Weaveform's contours; run 'weaveform post' again", file.string()));
  std::vector<Isoline> isolines(static_cast<std::size_t>(lines.GetNumberOfLines()));
  vtkNew<vtkIdList> ids;
  for (std::size_t k = 0; k < isolines.size(); ++k) {
    const auto line = static_cast<vtkIdType>(k);
    isolines[k].level = level->GetTuple1(line);
    lines.GetLines()->GetCellAtId(line, ids);
    for (const vtkIdType id : *ids) lines.GetPoint(id, isolines[k].point.emplace_back().data());
  }
  return isolines;
}

}  // namespace weaveform
