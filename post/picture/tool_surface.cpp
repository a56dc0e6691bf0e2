#include "post/picture/tool_surface.hpp"

#include <vtkCellArray.h>
#include <vtkPoints.h>

namespace weaveform {
namespace {

vtkSmartPointer<vtkPolyData> surface_of(const foreign::ToolMesh& mesh) {
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (const Vec3& x : mesh.node) points->InsertNextPoint(x.data());
  auto faces = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& face : mesh.face) {
    const int corners = face[3] < 0 ? 3 : 4;
    faces->InsertNextCell(corners);
    for (int c = 0; c < corners; ++c) faces->InsertCellPoint(face[c]);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(faces);
  return surface;
}

}  // namespace

std::vector<vtkSmartPointer<vtkPolyData>> tool_surfaces(const std::vector<NearTool>& tools) {
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  for (const NearTool& tool : tools) surfaces.push_back(surface_of(tool.surface));
  return surfaces;
}

}  // namespace weaveform
