#include "mesher/outline/blank_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/files/text_words.hpp"
#include "core/keys/length_unit.hpp"
#include "mesher/outline/cad_outline.hpp"
#include "mesher/outline/dxf_outline.hpp"
#include "mesher/outline/loops.hpp"
#include "mesher/tools/cad.hpp"

namespace weaveform {
namespace {

constexpr double outline_chord_tolerance = 0.01;  // mm; a hundredth of what a pair of scissors keeps

std::string outline_file(const Scene& scene) {
  const std::filesystem::path file = scene.blank.outline;
  return file.is_absolute() ? file.string() : (std::filesystem::path(scene.file).parent_path() / file).string();
}

DxfAsked dxf_asked(const Scene& scene) {
  return {scene.blank.outline_unit, scene.blank.outline_layers, outline_chord_tolerance};
}

bool names_its_unit(const std::string& file) {
  const std::string ending = upper(std::filesystem::path(file).extension().string());
  return ending == ".STEP" || ending == ".STP" || ending == ".IGES" || ending == ".IGS";
}

std::vector<OutlineLoop> file_loops(const Scene& scene, const std::string& file, std::vector<std::string>& notes,
                                    std::vector<std::string>& complaints) {
  if (is_dxf_file(file)) {
    auto drawn = read_dxf_outline(file, dxf_asked(scene), complaints);
    notes = std::move(drawn.notes);
    return std::move(drawn.loops);
  }
  if (!scene.blank.outline_layers.empty())
    complaints.push_back(file + ": blank.outline_layers means nothing to it; only a DXF drawing has layers");
  if (scene.blank.outline_unit && names_its_unit(file))
    complaints.push_back(file + ": STEP and IGES files name their unit themselves; leave blank.outline_unit out");
  auto loops = is_cad_file(file) ? read_cad_outline(file, outline_chord_tolerance, complaints)
                                 : read_outline_csv(file, complaints);
  for (auto& loop : loops)
    for (auto& point : loop.point)
      for (double& x : point) x *= millimetres_in(scene.blank.outline_unit);
  return loops;
}

std::vector<OutlineLoop> corner_loops(const BlankSpec& blank, std::vector<std::string>& complaints) {
  OutlineLoop loop;
  for (const auto& corner : blank.corners) {
    if (corner.size() != 2) {
      complaints.push_back(
          fmt::format("blank.corners: a corner has {} numbers; write [x, y] (mm) for each", corner.size()));
      return {};
    }
    loop.point.push_back({corner[0], corner[1]});
  }
  return sound_loops({loop}, "blank.corners", complaints);
}

}  // namespace

BlankOutline read_blank_outline(const Scene& scene) {
  const BlankShape shape = scene.blank.shape;
  BlankOutline outline;
  std::vector<std::string> complaints;
  if (shape == BlankShape::disc) outline.loops = {ellipse_loop(scene.blank.size)};
  if (shape == BlankShape::polygon) outline.loops = corner_loops(scene.blank, complaints);
  if (shape == BlankShape::file) {
    const std::string file = outline_file(scene);
    outline.loops = sound_loops(file_loops(scene, file, outline.notes, complaints), file, complaints);
  }
  if (!complaints.empty()) throw InputError(complaints);
  return outline;
}

lattice::Outline yarn_outline(const BlankSpec& blank, const BlankOutline& outline, const lattice::Turn& yarns) {
  if (blank.shape == BlankShape::rectangle) return lattice::rectangle_outline(blank.size, yarns);
  if (blank.shape == BlankShape::cross) return lattice::rectangle_outline({*blank.arm_width, *blank.arm_width}, yarns);
  lattice::Outline turned;
  for (const auto& loop : outline.loops)
    for (std::size_t k = 0; k < loop.point.size(); ++k)
      turned.edge.push_back({yarns.back(loop.point[k]), yarns.back(loop.point[(k + 1) % loop.point.size()]), {}});
  return turned;
}

std::array<double, 2> blank_extent(const BlankSpec& blank, const BlankOutline& outline) {
  if (blank.shape != BlankShape::polygon && blank.shape != BlankShape::file) return blank.size;
  const lattice::Box box = lattice::bounding_box(yarn_outline(blank, outline, lattice::Turn{}));
  return {box.high[0] - box.low[0], box.high[1] - box.low[1]};
}

}  // namespace weaveform
