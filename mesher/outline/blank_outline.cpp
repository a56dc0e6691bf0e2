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

std::vector<OutlineLoop> file_loops(const Scene& scene, const std::string& file, std::vector<std::string>& complaints) {
  if (is_dxf_file(file)) return read_dxf_outline(file, dxf_asked(scene), complaints).loops;
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

}  // namespace

std::vector<std::string> outline_notes(const Scene& scene) {
  if (scene.blank.shape != BlankShape::file || !is_dxf_file(scene.blank.outline)) return {};
  std::vector<std::string> complaints;  // the mesher's
  return read_dxf_outline(outline_file(scene), dxf_asked(scene), complaints).notes;
}

std::vector<OutlineLoop> blank_loops(const Scene& scene, std::vector<std::string>& complaints) {
  const BlankSpec& blank = scene.blank;
  if (blank.shape == BlankShape::disc) return {ellipse_loop(blank.size)};
  if (blank.shape == BlankShape::file) {
    const std::string file = outline_file(scene);
    return sound_loops(file_loops(scene, file, complaints), file, complaints);
  }
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

lattice::Outline blank_outline(const Scene& scene, const lattice::Turn& yarns, std::vector<std::string>& complaints) {
  const BlankSpec& blank = scene.blank;
  if (blank.shape == BlankShape::rectangle) return lattice::rectangle_outline(blank.size, yarns);
  if (blank.shape == BlankShape::cross) return lattice::rectangle_outline({*blank.arm_width, *blank.arm_width}, yarns);
  lattice::Outline outline;
  for (const auto& loop : blank_loops(scene, complaints))
    for (std::size_t k = 0; k < loop.point.size(); ++k)
      outline.edge.push_back({yarns.back(loop.point[k]), yarns.back(loop.point[(k + 1) % loop.point.size()]), {}});
  return outline;
}

std::array<double, 2> blank_extent(const Scene& scene) {
  if (scene.blank.shape != BlankShape::polygon && scene.blank.shape != BlankShape::file) return scene.blank.size;
  std::vector<std::string> complaints;
  const lattice::Outline outline = blank_outline(scene, lattice::Turn{}, complaints);
  if (!complaints.empty()) throw InputError(complaints);
  const lattice::Box box = lattice::bounding_box(outline);
  return {box.high[0] - box.low[0], box.high[1] - box.low[1]};
}

}  // namespace weaveform
