#include "mesher/outline/blank_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "mesher/base/error.hpp"
#include "mesher/outline/cad_outline.hpp"
#include "mesher/outline/loops.hpp"
#include "mesher/tools/cad.hpp"

namespace weaveform {
namespace {

constexpr double outline_chord_tolerance = 0.01;  // mm; a hundredth of what a pair of scissors keeps

std::string outline_file(const Scene& scene) {
  const std::filesystem::path file = scene.blank.outline;
  return file.is_absolute() ? file.string() : (std::filesystem::path(scene.file).parent_path() / file).string();
}

}  // namespace

std::vector<OutlineLoop> blank_loops(const Scene& scene, std::vector<std::string>& complaints) {
  const BlankSpec& blank = scene.blank;
  if (blank.shape == "disc") return {ellipse_loop(blank.size)};
  if (blank.shape == "file") {
    const std::string file = outline_file(scene);
    auto loops = is_cad_file(file) ? read_cad_outline(file, outline_chord_tolerance, complaints)
                                   : read_outline_csv(file, complaints);
    return sound_loops(std::move(loops), file, complaints);
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
  if (blank.shape == "rectangle") return lattice::rectangle_outline(blank.size, yarns);
  if (blank.shape == "cross") return lattice::rectangle_outline({*blank.arm_width, *blank.arm_width}, yarns);
  lattice::Outline outline;
  for (const auto& loop : blank_loops(scene, complaints))
    for (std::size_t k = 0; k < loop.point.size(); ++k)
      outline.edge.push_back({yarns.back(loop.point[k]), yarns.back(loop.point[(k + 1) % loop.point.size()]), ""});
  return outline;
}

std::array<double, 2> blank_extent(const Scene& scene) {
  if (scene.blank.shape != "polygon" && scene.blank.shape != "file") return scene.blank.size;
  std::vector<std::string> complaints;
  const lattice::Outline outline = blank_outline(scene, lattice::Turn{}, complaints);
  if (!complaints.empty()) throw InputError(complaints);
  const lattice::Box box = lattice::bounding_box(outline);
  return {box.high[0] - box.low[0], box.high[1] - box.low[1]};
}

}  // namespace weaveform
