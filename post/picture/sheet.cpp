#include "post/picture/sheet.hpp"

#include <fmt/format.h>
#include <vtkCellType.h>

#include "core/error.hpp"
#include "core/findings.hpp"
#include "mesher/mesh/mesh_io.hpp"
#include "mesher/mesh/vtu_grid.hpp"
#include "mesher/resolve/resolve.hpp"
#include "mesher/scene/scene_copy.hpp"
#include "post/forming/placed_tools.hpp"
#include "post/output/drape_result.hpp"
#include "solver/result/file_names.hpp"

namespace weaveform {
namespace {

namespace fs = std::filesystem;

bool is_drape(const fs::path& directory) {
  return !fs::exists(directory / file_name::index) && fs::exists(directory / file_name::drape);
}

}  // namespace

std::vector<FrameFile> frames_to_draw(ResultFolder& folder) {
  if (is_drape(folder.directory())) return {{0.0, folder.directory() / file_name::drape}};
  return folder.frames();
}

Resolved model_to_draw(ResultFolder& folder) {
  if (fs::exists(folder.directory() / file_name::mesh)) return folder.model();
  Findings found;
  Resolved model = resolve(folder.directory() / file_name::scene, {}, found, {}, ResolveTo::flat);
  found.throw_if_any();
  return model;
}

std::vector<Vec3> tools_moved(ResultFolder& folder, const Resolved& model, double time) {
  if (is_drape(folder.directory())) return std::vector<Vec3>(model.tools.size(), Vec3{0.0, 0.0, 0.0});
  return displacements(model.tools, folder.history(), time);
}

Sheet read_sheet(const fs::path& file, const std::string& field) {
  VtuGrid grid = read_vtu(file, std::vector<std::string>{field}, "make it again");
  const VtuArray* array = find_array(grid.cell_data, field);
  if (array == nullptr || array->components != 1)
    throw InputError(
        fmt::format("{}: has no '{}' on its cells to colour them by; --field takes another", file.string(), field));
  Sheet sheet;
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    std::vector<int> corner;
    for (std::int64_t k = grid.offset[c]; k < grid.offset[c + 1]; ++k)
      corner.push_back(static_cast<int>(grid.node[static_cast<std::size_t>(k)]));
    if (grid.type[c] == VTK_LINE) {
      sheet.yarn.push_back({corner[0], corner[1]});
    } else if (corner.size() > 2) {
      sheet.polygon.push_back(std::move(corner));
      sheet.value.push_back(array->as_double(c));
    }
  }
  sheet.position = std::move(grid.point);
  return sheet;
}

}  // namespace weaveform
