#include "mesher/symmetry/find_symmetry.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace weaveform {
namespace {

constexpr std::array<const char*, 2> plane_name = {"x = 0", "y = 0"};

std::size_t planes_wanted(SymmetryUse asked) {
  return asked == SymmetryUse::none ? 0 : asked == SymmetryUse::half ? 1 : 2;
}

[[noreturn]] void refuse(const Scene& scene, const Symmetry& symmetry) {
  const std::size_t axis = symmetry.why[0].empty() ? 1 : 0;
  throw InputError(fmt::format("{}model.symmetry: the scene is no {}: plane {} of the blank: {}; use \"auto\"",
                               scene.file.empty() ? "" : scene.file + ": ", name_of(symmetry.asked), plane_name[axis],
                               symmetry.why[axis]));
}

}  // namespace

std::string Symmetry::word() const {
  return plane.empty() ? "none" : plane.size() == 1 ? "half" : "quarter";
}

Symmetry find_symmetry(const Scene& scene, const Card& card, const Mesh& mesh, const std::vector<Tool>& tools) {
  Symmetry symmetry;
  symmetry.asked = scene.model.symmetry;
  const std::size_t wanted = planes_wanted(symmetry.asked);
  for (int axis = 0; axis < 2 && symmetry.plane.size() < wanted; ++axis) {
    const SymmetryPlane plane = blank_plane(scene.blank, axis);
    MirrorMap map;
    std::string& why = symmetry.why[axis];
    why = find_load_difference(scene, tools, axis);
    if (why.empty()) why = find_mirror_map(mesh, plane, map);
    if (why.empty()) why = find_law_difference(scene, card, map);
    if (!why.empty()) continue;
    symmetry.plane.push_back(plane);
    symmetry.map.push_back(std::move(map));
  }
  if (symmetry.asked != SymmetryUse::automatic && symmetry.plane.size() < wanted) refuse(scene, symmetry);
  return symmetry;
}

std::string describe(const Symmetry& symmetry) {
  if (symmetry.asked == SymmetryUse::none) return "symmetry: not used, the whole blank is solved";
  std::string line = "symmetry: ";
  if (symmetry.plane.empty()) line += "none, the whole blank is solved";
  if (symmetry.plane.size() == 1) line += "a half of the blank is solved";
  if (symmetry.plane.size() == 2) line += "a quarter of the blank is solved";
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (!symmetry.why[axis].empty()) line += fmt::format("; plane {}: {}", plane_name[axis], symmetry.why[axis]);
  return line;
}

}  // namespace weaveform
