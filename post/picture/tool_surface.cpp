#include "post/picture/tool_surface.hpp"

#include <vtkCellArray.h>
#include <vtkPoints.h>

#include "mesher/exchange/tool_mesh.hpp"

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

std::vector<vtkSmartPointer<vtkPolyData>> tool_surfaces(const Resolved& model) {
  constexpr double any_duration = 1.0;  // s; the surfaces are those at the start
  const auto gathered = foreign::gather(model.scene, model.card, model.mesh, model.tools, any_duration, "");
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  for (const foreign::ToolMotion& tool : gathered.tools) surfaces.push_back(surface_of(mesh_of_tool(gathered, tool)));
  return surfaces;
}

}  // namespace weaveform
