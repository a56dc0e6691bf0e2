// The files of an evaluation: tables, charts, and what a viewer lays over the frames.
#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSignedCharArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/chart/chart.hpp"
#include "core/files/csv.hpp"
#include "core/files/files.hpp"
#include "core/vector/angle.hpp"
#include "mesher/mesh/vtk_file.hpp"
#include "post/forming/forming.hpp"
#include "post/forming/forming_charts.hpp"
#include "solver/result/chart_file.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

void write_meridians(const Forming& forming, const fs::path& directory) {
  std::string table = "azimuth_deg,arc_mm,shear_angle_deg,height_mm,radius_mm,x_mm,y_mm,z_mm\n";
  for (std::size_t k = 0; k < meridian_azimuths.size(); ++k)
    for (const MeridianPoint& p : forming.meridian[k])
      table +=
          fmt::format("{:g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g},{:.10g}\n", meridian_azimuths[k], p.arc,
                      p.angle * degrees_per_radian, p.height, p.radius, p.place.x(), p.place.y(), p.place.z());
  write_text_whole(directory / file_name::meridians, table);
}

void write_polydata(vtkPolyData& data, const fs::path& file) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&data);
  write_vtk_whole(file, *writer);
}

// Two closed lines: before (cell data `formed` 0) and after (1).
void write_outline_lines(const Forming& forming, const Mesh& mesh, const Fields& fields, const fs::path& file) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> lines;
  vtkNew<vtkIntArray> formed, node;
  formed->SetName("formed");
  node->SetName("node");
  vtkNew<vtkDoubleArray> inwards;
  inwards->SetName("draw_in_mm");
  for (const bool after : {false, true}) {
    const std::vector<Vec3>& position = after ? fields.position : flat_positions(mesh);
    const auto nodes = static_cast<vtkIdType>(forming.outline.size());
    const vtkIdType first = points->GetNumberOfPoints();
    lines->InsertNextCell(static_cast<int>(nodes + 1));
    for (vtkIdType k = 0; k <= nodes; ++k) lines->InsertCellPoint(first + k % nodes);
    for (const int n : forming.outline) {
      points->InsertNextPoint(position[n].data());
      node->InsertNextValue(n);
      inwards->InsertNextValue(forming.axis.radius(vector_of(flat_positions(mesh)[n])) -
                               forming.axis.radius(vector_of(fields.position[n])));
    }
    formed->InsertNextValue(after ? 1 : 0);
  }
  data->SetPoints(points);
  data->SetLines(lines);
  data->GetCellData()->AddArray(formed);
  data->GetPointData()->AddArray(node);
  data->GetPointData()->SetScalars(inwards);
  write_polydata(*data, file);
}

void write_outline(const Forming& forming, const Mesh& mesh, const Fields& fields, const fs::path& directory) {
  std::string table = "azimuth_deg,radius_before_mm,radius_after_mm,draw_in_mm\n";
  for (const DrawInRow& r : forming.draw_in.row)
    table += fmt::format("{:g},{:.10g},{:.10g},{:.10g}\n", std::round(r.azimuth * degrees_per_radian), r.before,
                         r.after, r.draw_in());
  write_text_whole(directory / file_name::outline, table);
  write_outline_lines(forming, mesh, fields, directory / file_name::outline_lines);
}

void write_wrinkles(const Forming& forming, const Mesh& mesh, const Fields& fields, const fs::path& file) {
  const Wrinkles& wrinkles = forming.wrinkles;
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> relief, curvature, gap;
  vtkNew<vtkSignedCharArray> wrinkled, folded;
  relief->SetName("wrinkle_relief_mm");
  curvature->SetName("wrinkle_curvature_per_mm");
  gap->SetName("contact_gap_mm");
  wrinkled->SetName("wrinkled");
  folded->SetName("folded");
  for (std::size_t n = 0; n < fields.position.size(); ++n) {
    points->InsertNextPoint(fields.position[n].data());
    relief->InsertNextValue(wrinkles.relief[n]);
    curvature->InsertNextValue(wrinkles.curvature[n]);
    gap->InsertNextValue(forming.gap[n]);
    wrinkled->InsertNextValue(wrinkles.wrinkled[n] ? 1 : 0);
  }
  vtkNew<vtkCellArray> polygons;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int begin = mesh.cells.offset[cell], nodes = mesh.cells.offset[cell + 1] - begin;
    polygons->InsertNextCell(nodes);
    for (int k = 0; k < nodes; ++k) polygons->InsertCellPoint(mesh.cells.node[begin + k]);
    folded->InsertNextValue(fields.folded[cell] ? 1 : 0);
  }
  data->SetPoints(points);
  data->SetPolys(polygons);
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{relief, curvature, gap, wrinkled})
    data->GetPointData()->AddArray(array);
  data->GetCellData()->AddArray(folded);
  write_polydata(*data, file);
}

void write_sphere_net(const SphereNetFit& fit, const fs::path& directory) {
  std::string table = "cell,u_mm,v_mm,s,shear_angle_deg,net_deg,on_sphere\n";
  for (std::size_t c = 0; c < fit.cell.size(); ++c) {
    const SphereNetCell& cell = fit.cell[c];
    table +=
        fmt::format("{},{:.10g},{:.10g},{:.10g},{:.10g},{},{}\n", c, cell.u, cell.v, cell.s,
                    cell.angle * degrees_per_radian, csv_number(cell.net * degrees_per_radian), cell.on_sphere ? 1 : 0);
  }
  write_text_whole(directory / file_name::sphere_net, table);
}

void write_forming_charts(const Forming& forming, const fs::path& directory) {
  std::vector<std::pair<fs::path, Chart>> charts = {{directory / file_name::meridian_chart, meridian_chart(forming)}};
  if (forming.punch) charts.emplace_back(directory / file_name::punch_chart, punch_chart(*forming.punch));
  if (forming.sphere_net)
    charts.emplace_back(directory / file_name::sphere_net_chart, sphere_net_chart(*forming.sphere_net));
  write_charts(charts);
}

}  // namespace

void write_forming(const Forming& forming, const Mesh& mesh, const Fields& fields, const fs::path& directory) {
  remove_files(directory, forming_files());
  write_meridians(forming, directory);
  write_outline(forming, mesh, fields, directory);
  write_wrinkles(forming, mesh, fields, directory / file_name::wrinkles);
  if (forming.sphere_net) write_sphere_net(*forming.sphere_net, directory);
  write_forming_charts(forming, directory);
}

}  // namespace weaveform
