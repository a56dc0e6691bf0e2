#include "post/output/drape_result.hpp"

#include <fmt/format.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
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

// Lines and polygons of all blanks, in drape.vtu's order.
class DrapeGrid {
public:
  explicit DrapeGrid(bool of_stack) : of_stack_(of_stack) {
    points_->SetDataTypeToDouble();
    flat_->SetName("flat_position_mm");
    flat_->SetNumberOfComponents(3);
    point_ply_->SetName("ply");
    angle_->SetName("shear_angle_deg");
    absolute_angle_->SetName("absolute_shear_angle_deg");
    folded_->SetName("folded");
    extrapolated_->SetName("extrapolated");
    family_->SetName("family");
    ply_->SetName("ply");
    grid_->SetPoints(points_);
  }

  void add_points(const DrapedBlank& blank, int ply) {
    std::vector<vtkIdType>& point = point_.emplace_back(blank.mesh.node_count(), -1);
    for (int n = 0; n < blank.mesh.node_count(); ++n) {
      if (blank.drape.placed[n] == 0) continue;
      point[n] = points_->InsertNextPoint(blank.drape.laid[n].data());
      flat_->InsertNextTuple(blank.mesh.nodes.position[n].data());
      point_ply_->InsertNextValue(ply);
    }
  }

  void add_lines(const DrapedBlank& blank, int ply) {
    const std::vector<vtkIdType>& point = point_[static_cast<std::size_t>(ply)];
    for (int e = 0; e < blank.mesh.yarn_count(); ++e) {
      const vtkIdType ends[2] = {point[blank.mesh.yarns.node[e][0]], point[blank.mesh.yarns.node[e][1]]};
      if (ends[0] < 0 || ends[1] < 0) continue;
      grid_->InsertNextCell(VTK_LINE, 2, ends);
      add_values(0.0, false, false, blank.mesh.yarns.family[e] == Family::warp ? 1 : 2, ply);
    }
  }

  void add_cells(const DrapedBlank& blank, int ply) {
    const std::vector<vtkIdType>& point = point_[static_cast<std::size_t>(ply)];
    const MeshCells& cells = blank.mesh.cells;
    for (int c = 0; c < cells.size(); ++c) {
      if (std::isnan(blank.drape.shear_angle[c])) continue;
      std::vector<vtkIdType> corner;
      for (int a = cells.offset[c]; a < cells.offset[c + 1]; ++a) corner.push_back(point[cells.node[a]]);
      grid_->InsertNextCell(corner.size() == 4 ? VTK_QUAD : VTK_POLYGON, static_cast<vtkIdType>(corner.size()),
                            corner.data());
      add_values(blank.drape.shear_angle[c] * to_deg, blank.drape.folded[c] != 0, blank.drape.extrapolated[c] != 0, 0,
                 ply);
    }
  }

  void write(const std::filesystem::path& file) {
    grid_->GetPointData()->AddArray(flat_);
    for (vtkDataArray* array :
         std::initializer_list<vtkDataArray*>{angle_, absolute_angle_, folded_, extrapolated_, family_})
      grid_->GetCellData()->AddArray(array);
    if (of_stack_) {
      grid_->GetPointData()->AddArray(point_ply_);
      grid_->GetCellData()->AddArray(ply_);
    }
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetInputData(grid_);
    write_vtk_whole(file, *writer);
  }

private:
  void add_values(double angle, bool is_folded, bool is_extrapolated, int family, int ply) {
    angle_->InsertNextValue(angle);
    absolute_angle_->InsertNextValue(std::abs(angle));
    folded_->InsertNextValue(is_folded ? 1 : 0);
    extrapolated_->InsertNextValue(is_extrapolated ? 1 : 0);
    family_->InsertNextValue(static_cast<unsigned char>(family));
    ply_->InsertNextValue(ply);
  }

  bool of_stack_;
  std::vector<std::vector<vtkIdType>> point_;  // per ply and node: its point, -1 without a place
  vtkNew<vtkPoints> points_;
  vtkNew<vtkDoubleArray> flat_, angle_, absolute_angle_;
  vtkNew<vtkUnsignedCharArray> folded_, extrapolated_, family_;
  vtkNew<vtkIntArray> point_ply_, ply_;
  vtkNew<vtkUnstructuredGrid> grid_;
};

bool are_plies(const std::vector<DrapedBlank>& blanks) {
  return !blanks.front().ply.empty();
}

void write_grid(const std::vector<DrapedBlank>& blanks, const std::filesystem::path& file) {
  DrapeGrid grid(are_plies(blanks));
  const int count = static_cast<int>(blanks.size());
  for (int k = 0; k < count; ++k) grid.add_points(blanks[k], k);
  for (int k = 0; k < count; ++k) grid.add_lines(blanks[k], k);
  for (int k = 0; k < count; ++k) grid.add_cells(blanks[k], k);
  grid.write(file);
}

nlohmann::ordered_json places_json(const std::vector<DrapePlace>& places) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& place : places) list.push_back({{"what", place.what}, {"at_mm", place.at}, {"count", place.count}});
  return list;
}

int sum_of_counts(const std::vector<DrapePlace>& places) {
  return std::accumulate(places.begin(), places.end(), 0, [](int sum, const DrapePlace& p) { return sum + p.count; });
}

// What one blank's drape says against itself.
std::vector<std::string> warnings_of(const DrapedBlank& blank) {
  std::vector<std::string> lines;
  const DrapeSummary s = summarise(blank.mesh, blank.card, blank.drape);
  if (s.cells_beyond_card > 0)
    lines.push_back(fmt::format(
        "{} of {} cells are sheared beyond the {:g} degrees to which the card's shear law is meant to hold, up to "
        "{:.3g} "
        "degrees: fabric of this card need not drape so; lay it from another seed or direction, or cut darts",
        s.cells_beyond_card, s.cells_placed, blank.card.shear.valid_to_deg, s.max_shear_angle_deg));
  constexpr std::size_t most = 5;  // of a kind; the file has all
  for (const auto* places : {&blank.drape.unreachable, &blank.drape.folds, &blank.drape.tight}) {
    for (std::size_t k = 0; k < std::min(places->size(), most); ++k) lines.push_back(place_line((*places)[k]));
    if (places->size() > most)
      lines.push_back(fmt::format("and {} more like it, see drape.json", places->size() - most));
  }
  return lines;
}

nlohmann::ordered_json json_of(const DrapedBlank& blank) {
  const Drape& drape = blank.drape;
  const DrapeSummary s = summarise(blank.mesh, blank.card, drape);
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
          {"flat_area_mm2", pattern_area(flat_pattern(blank.scene, blank.mesh, blank.tools, drape))},
          {"length_error", drape.length_error},
          {"net_cells", drape.net_cells},
          {"wall_s", drape.wall_s},
          {"cells_per_s", s.cells_per_s},
          {"unreachable", places_json(drape.unreachable)},
          {"folds", places_json(drape.folds)},
          {"tight", places_json(drape.tight)},
          {"warnings", warnings_of(blank)}};
}

// Sums, and the greatest of all; what only one ply has stands with the ply.
nlohmann::ordered_json json_of_stack(const std::vector<DrapedBlank>& blanks) {
  nlohmann::ordered_json all = {{"tool", blanks.front().drape.tool}}, plies;
  for (const DrapedBlank& blank : blanks) {
    nlohmann::ordered_json own = {{"material", blank.card.name}, {"off_tool_mm", blank.off_tool}};
    own.update(json_of(blank));
    for (const char* sum :
         {"cells", "cells_placed", "folded_cells", "unreachable_crossings", "cells_beyond_card", "extrapolated_cells"})
      all[sum] = all.value(sum, 0) + own[sum].get<int>();
    all["max_shear_angle_deg"] =
        std::max(all.value("max_shear_angle_deg", 0.0), own["max_shear_angle_deg"].get<double>());
    plies[blank.ply] = std::move(own);
  }
  all["plies"] = std::move(plies);
  all["warnings"] = drape_warnings(blanks);
  return all;
}

std::string describe(const DrapedBlank& blank) {
  const DrapeSummary s = summarise(blank.mesh, blank.card, blank.drape);
  std::string text = fmt::format(
      "{} of {} cells placed, {} folded; greatest shear angle {:.4g} deg, mean {:.4g} deg; yarn lengths "
      "kept to {:.1g}; {:.3g} cells/s",
      s.cells_placed, s.cells, s.folded_cells, s.max_shear_angle_deg, s.mean_shear_angle_deg, blank.drape.length_error,
      s.cells_per_s);
  if (s.extrapolated_cells > 0)
    text += fmt::format(
        "\nnote: {} cells cut by the blank's edge where the tool ends: their angle continues the tool in its "
        "tangent plane (array 'extrapolated' of drape.vtu)",
        s.extrapolated_cells);
  return text;
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

nlohmann::ordered_json write_drape(const std::vector<DrapedBlank>& blanks, const std::filesystem::path& directory) {
  write_grid(blanks, directory / file_name::drape);
  for (const DrapedBlank& blank : blanks)
    write_text_whole((are_plies(blanks) ? ply_folder(directory, blank.ply) : directory) / file_name::flat_pattern,
                     flat_pattern_csv(flat_pattern(blank.scene, blank.mesh, blank.tools, blank.drape)));
  nlohmann::ordered_json json = are_plies(blanks) ? json_of_stack(blanks) : json_of(blanks.front());
  write_text_whole(directory / file_name::drape_numbers, json_text(json));
  return json;
}

std::string describe_drape(const std::vector<DrapedBlank>& blanks) {
  const std::string on = fmt::format("drape on '{}': ", blanks.front().drape.tool);
  if (!are_plies(blanks)) return on + describe(blanks.front());
  std::string text = fmt::format("{}{} plies", on, blanks.size());
  for (const DrapedBlank& blank : blanks)
    text += fmt::format("\n  ply '{}', {:.4g} mm off the tool: {}", blank.ply, blank.off_tool, describe(blank));
  return text;
}

std::vector<std::string> drape_warnings(const std::vector<DrapedBlank>& blanks) {
  if (!are_plies(blanks)) return warnings_of(blanks.front());
  std::vector<std::string> lines;
  for (const DrapedBlank& blank : blanks)
    for (const std::string& line : warnings_of(blank)) lines.push_back(fmt::format("ply '{}': {}", blank.ply, line));
  return lines;
}

}  // namespace weaveform
