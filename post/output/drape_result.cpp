#include "post/output/drape_result.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <vector>

#include "core/files/files.hpp"
#include "core/json/json_text.hpp"
#include "mesher/drape/flat_pattern.hpp"
#include "mesher/mesh/vtk_file.hpp"

namespace weaveform {
namespace {

constexpr double to_deg = 180.0 / std::numbers::pi;

void write_grid(const Mesh& mesh, const Drape& drape, const std::filesystem::path& file) {
  std::vector<vtkIdType> point(mesh.node_count(), -1);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> flat, angle, absolute_angle;
  flat->SetName("flat_position_mm");
  flat->SetNumberOfComponents(3);
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (drape.placed[n] == 0) continue;
    point[n] = points->InsertNextPoint(drape.laid[n].data());
    flat->InsertNextTuple(mesh.nodes.position[n].data());
  }
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  angle->SetName("shear_angle_deg");
  absolute_angle->SetName("absolute_shear_angle_deg");
  vtkNew<vtkUnsignedCharArray> folded, extrapolated, family;
  folded->SetName("folded");
  extrapolated->SetName("extrapolated");
  family->SetName("family");
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    const vtkIdType ends[2] = {point[mesh.yarns.node[e][0]], point[mesh.yarns.node[e][1]]};
    if (ends[0] < 0 || ends[1] < 0) continue;
    grid->InsertNextCell(VTK_LINE, 2, ends);
    angle->InsertNextValue(0.0);
    absolute_angle->InsertNextValue(0.0);
    folded->InsertNextValue(0);
    extrapolated->InsertNextValue(0);
    family->InsertNextValue(mesh.yarns.family[e] == Family::warp ? 1 : 2);
  }
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (std::isnan(drape.shear_angle[c])) continue;
    std::vector<vtkIdType> corner;
    for (int a = mesh.cells.offset[c]; a < mesh.cells.offset[c + 1]; ++a) corner.push_back(point[mesh.cells.node[a]]);
    grid->InsertNextCell(corner.size() == 4 ? VTK_QUAD : VTK_POLYGON, static_cast<vtkIdType>(corner.size()),
                         corner.data());
    angle->InsertNextValue(drape.shear_angle[c] * to_deg);
    absolute_angle->InsertNextValue(std::abs(drape.shear_angle[c]) * to_deg);
    folded->InsertNextValue(static_cast<unsigned char>(drape.folded[c]));
    extrapolated->InsertNextValue(static_cast<unsigned char>(drape.extrapolated[c]));
    family->InsertNextValue(0);
  }
  grid->GetPointData()->AddArray(flat);
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{angle, absolute_angle, folded, extrapolated, family})
    grid->GetCellData()->AddArray(array);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  write_vtk_whole(file, *writer);
}

nlohmann::ordered_json places_json(const std::vector<DrapePlace>& places) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& place : places) list.push_back({{"what", place.what}, {"at_mm", place.at}, {"count", place.count}});
  return list;
}

int sum_of_counts(const std::vector<DrapePlace>& places) {
  return std::accumulate(places.begin(), places.end(), 0, [](int sum, const DrapePlace& p) { return sum + p.count; });
}

}  // namespace

DrapeSummary summarise(const Mesh& mesh, const Card& card, const Drape& drape) {
  DrapeSummary s;
  s.cells = mesh.cells.size();
  double area = 0.0;
  for (int c = 0; c < s.cells; ++c) {
    if (std::isnan(drape.shear_angle[c])) continue;
    ++s.cells_placed;
    s.folded_cells += drape.folded[c];
    s.extrapolated_cells += drape.extrapolated[c];
    if (drape.folded[c] != 0) continue;
    const double degrees = std::abs(drape.shear_angle[c]) * to_deg;
    s.max_shear_angle_deg = std::max(s.max_shear_angle_deg, degrees);
    s.mean_shear_angle_deg += mesh.cells.area[c] * degrees;
    area += mesh.cells.area[c];
    s.cells_beyond_card += degrees > card.shear.valid_to_deg ? 1 : 0;
  }
  if (area > 0.0) s.mean_shear_angle_deg /= area;
  s.unreachable_crossings = sum_of_counts(drape.unreachable);
  s.cells_per_s = drape.wall_s > 0.0 ? drape.net_cells / drape.wall_s : 0.0;
  return s;
}

nlohmann::ordered_json drape_json(const Scene& scene, const Mesh& mesh, const Card& card,
                                  const std::vector<Tool>& tools, const Drape& drape) {
  const DrapeSummary s = summarise(mesh, card, drape);
  return {{"tool", drape.tool},
          {"seed_mm", drape.seed},
          {"cells", s.cells},
          {"cells_placed", s.cells_placed},
          {"folded_cells", s.folded_cells},
          {"unreachable_crossings", s.unreachable_crossings},
          {"cells_beyond_card", s.cells_beyond_card},
          {"max_shear_angle_deg", s.max_shear_angle_deg},
          {"extrapolated_cells", s.extrapolated_cells},
          {"mean_shear_angle_deg", s.mean_shear_angle_deg},
          {"flat_area_mm2", pattern_area(flat_pattern(scene, mesh, tools, drape))},
          {"length_error", drape.length_error},
          {"net_cells", drape.net_cells},
          {"wall_s", drape.wall_s},
          {"cells_per_s", s.cells_per_s},
          {"unreachable", places_json(drape.unreachable)},
          {"folds", places_json(drape.folds)},
          {"tight", places_json(drape.tight)},
          {"warnings", drape_warnings(mesh, card, drape)}};
}

nlohmann::ordered_json write_drape(const Scene& scene, const Mesh& mesh, const Card& card,
                                   const std::vector<Tool>& tools, const Drape& drape,
                                   const std::filesystem::path& directory) {
  write_grid(mesh, drape, directory / file_name::drape);
  write_text_whole(directory / file_name::flat_pattern, flat_pattern_csv(flat_pattern(scene, mesh, tools, drape)));
  nlohmann::ordered_json json = drape_json(scene, mesh, card, tools, drape);
  write_text_whole(directory / file_name::drape_numbers, json_text(json));
  return json;
}

std::string describe_drape(const Mesh& mesh, const Card& card, const Drape& drape) {
  const DrapeSummary s = summarise(mesh, card, drape);
  std::string text = fmt::format(
      "drape on '{}': {} of {} cells placed, {} folded; greatest shear angle {:.4g} deg, mean {:.4g} deg; yarn lengths "
      "kept to {:.1g}; {:.3g} cells/s",
      drape.tool, s.cells_placed, s.cells, s.folded_cells, s.max_shear_angle_deg, s.mean_shear_angle_deg,
      drape.length_error, s.cells_per_s);
  if (s.extrapolated_cells > 0)
    text += fmt::format(
        "\nnote: {} cells cut by the blank's edge where the tool ends: their angle continues the tool in its "
        "tangent plane (array 'extrapolated' of drape.vtu)",
        s.extrapolated_cells);
  return text;
}

std::vector<std::string> drape_warnings(const Mesh& mesh, const Card& card, const Drape& drape) {
  std::vector<std::string> lines;
  const DrapeSummary s = summarise(mesh, card, drape);
  if (s.cells_beyond_card > 0)
    lines.push_back(fmt::format(
        "{} of {} cells are sheared beyond the {:g} degrees to which the card's shear law is meant to hold, up to "
        "{:.3g} "
        "degrees: fabric of this card need not drape so; lay it from another seed or direction, or cut darts",
        s.cells_beyond_card, s.cells_placed, card.shear.valid_to_deg, s.max_shear_angle_deg));
  constexpr std::size_t most = 5;  // of a kind; the file has all
  for (const auto* places : {&drape.unreachable, &drape.folds, &drape.tight}) {
    for (std::size_t k = 0; k < std::min(places->size(), most); ++k) lines.push_back(place_line((*places)[k]));
    if (places->size() > most)
      lines.push_back(fmt::format("and {} more like it, see drape.json", places->size() - most));
  }
  return lines;
}

}  // namespace weaveform
