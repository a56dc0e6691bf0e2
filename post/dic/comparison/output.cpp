#include "post/dic/comparison/output.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <iterator>

#include "core/files/files.hpp"
#include "core/vector/angle.hpp"
#include "mesher/mesh/vtk_file.hpp"

namespace weaveform::dic {
namespace {

void append_number(fmt::memory_buffer& text, double value) {
  text.push_back(',');
  if (std::isfinite(value)) fmt::format_to(std::back_inserter(text), FMT_COMPILE("{:.7g}"), value);
}

std::vector<double> in_degrees(const std::vector<double>& angle) {
  std::vector<double> result;
  result.reserve(angle.size());
  for (const double value : angle) result.push_back(value * degrees_per_radian);
  return result;
}

void add_scalars(vtkPointData& data, const char* name, const std::vector<double>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data.AddArray(array);
}

void add_vectors(vtkPointData& data, const char* name, const std::vector<Vec3>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  double* next = array->GetPointer(0);
  for (const Vec3& v : values) next = std::copy(v.begin(), v.end(), next);
  data.AddArray(array);
}

vtkSmartPointer<vtkPoints> flat_points(const std::vector<Vec2>& place) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(place.size()));
  for (std::size_t i = 0; i < place.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), place[i][0], place[i][1], 0.0);
  return points;
}

}  // namespace

int agreement(const StageFields& fields, std::size_t i, double coverage) {
  if (!std::isfinite(fields.difference[i]) || !std::isfinite(fields.uncertainty[i])) return -1;
  return std::abs(fields.difference[i]) <= coverage * fields.uncertainty[i] ? 1 : 0;
}

void write_points_csv(const StageFields& fields, double coverage, const std::filesystem::path& file) {
  fmt::memory_buffer text;
  const std::string_view heading =
      "x_mm,y_mm,measured_ux_mm,measured_uy_mm,measured_uz_mm,levelled_ux_mm,levelled_uy_mm,levelled_uz_mm,"
      "measured_deg,levelled_deg,raw_deg,difference_deg,uncertainty_deg,agrees\n";
  text.append(heading.data(), heading.data() + heading.size());
  const auto& point = fields.points->point;
  for (std::size_t i = 0; i < point.size(); ++i) {
    fmt::format_to(std::back_inserter(text), FMT_COMPILE("{:.7g},{:.7g}"), point[i][0], point[i][1]);
    const bool valid = fields.valid[i];
    for (std::size_t k = 0; k < 3; ++k) append_number(text, valid ? fields.measured_displacement[i][k] : NAN);
    for (std::size_t k = 0; k < 3; ++k)
      append_number(text, fields.points->facets.found(i) ? fields.levelled_displacement[i][k] : NAN);
    for (const auto* angle : {&fields.measured, &fields.levelled, &fields.raw, &fields.difference, &fields.uncertainty})
      append_number(text, (*angle)[i] * degrees_per_radian);
    const int agrees = agreement(fields, i, coverage);
    text.push_back(',');
    if (agrees >= 0) text.push_back(agrees == 1 ? '1' : '0');
    text.push_back('\n');
  }
  write_text_whole(file, {text.data(), text.size()});
}

void write_points_vtu(const StageFields& fields, const std::vector<std::array<int, 3>>& triangles, double coverage,
                      const std::filesystem::path& file) {
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(flat_points(fields.points->point));
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(static_cast<vtkIdType>(triangles.size()), static_cast<vtkIdType>(3 * triangles.size()));
  for (const auto& triangle : triangles) {
    cells->InsertNextCell(3);
    for (const int corner : triangle) cells->InsertCellPoint(corner);
  }
  grid->SetCells(VTK_TRIANGLE, cells);
  vtkPointData& data = *grid->GetPointData();
  add_scalars(data, "measured_deg", in_degrees(fields.measured));
  add_scalars(data, "levelled_deg", in_degrees(fields.levelled));
  add_scalars(data, "raw_deg", in_degrees(fields.raw));
  add_scalars(data, "difference_deg", in_degrees(fields.difference));
  add_scalars(data, "uncertainty_deg", in_degrees(fields.uncertainty));
  add_vectors(data, "measured_displacement_mm", fields.measured_displacement);
  add_vectors(data, "levelled_displacement_mm", fields.levelled_displacement);
  vtkNew<vtkSignedCharArray> agrees;
  agrees->SetName("agrees");
  for (std::size_t i = 0; i < fields.valid.size(); ++i)
    agrees->InsertNextValue(static_cast<signed char>(agreement(fields, i, coverage)));
  data.AddArray(agrees);
  data.SetActiveScalars("difference_deg");
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk_whole(file, *writer);
}

void write_isolines(const StageFields& fields, const std::vector<std::array<int, 3>>& triangles, double step,
                    const std::filesystem::path& file) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkDoubleArray> level;
  level->SetName("shear_angle_deg");
  vtkNew<vtkSignedCharArray> field;
  field->SetName("field");
  signed char number = 0;
  for (const auto* angle : {&fields.measured, &fields.levelled, &fields.raw}) {
    for (const Isoline& line : isolines(fields.points->point, triangles, in_degrees(*angle), step)) {
      lines->InsertNextCell(static_cast<int>(line.point.size()));
      for (const Vec3& p : line.point) lines->InsertCellPoint(points->InsertNextPoint(p.data()));
      level->InsertNextValue(line.level);
      field->InsertNextValue(number);
    }
    ++number;
  }
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->SetScalars(level);
  data->GetCellData()->AddArray(field);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  write_vtk_whole(file, *writer);
}

}  // namespace weaveform::dic
