#include "mesher/symmetry/find_symmetry.hpp"

#include <fmt/format.h>

#include <cmath>

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

constexpr double same_place = 1e-9;  // mm, and of a unit vector's component

bool is_same_plane(const SymmetryPlane& one, const SymmetryPlane& other) {
  double off = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (std::abs(one.normal[c] - other.normal[c]) > same_place) return false;
    off += (one.point[c] - other.point[c]) * one.normal[c];
  }
  return std::abs(off) <= same_place;
}

// "" or what stands against the plane, which is that across `axis` of the lowest ply's blank. Fills `map`.
std::string difference(const PlyToMirror& ply, const std::vector<Tool>& tools, const SymmetryPlane& plane, int axis,
                       MirrorMap& map) {
  if (!is_same_plane(plane, blank_plane(ply.scene.blank, axis))) return "its blank has the plane elsewhere";
  std::string why = find_load_difference(ply.scene, tools, axis);
  if (why.empty()) why = find_mirror_map(ply.mesh, plane, map);
  if (why.empty()) why = find_law_difference(ply.scene, ply.card, map);
  return why;
}

}  // namespace

std::string Symmetry::word() const {
  return plane.empty() ? "none" : plane.size() == 1 ? "half" : "quarter";
}

Symmetry find_symmetry(const Scene& scene, const Card& card, const Mesh& mesh, const std::vector<Tool>& tools) {
  return find_symmetry({{"", scene, card, mesh}}, tools).front();
}

std::vector<Symmetry> find_symmetry(const std::vector<PlyToMirror>& plies, const std::vector<Tool>& tools) {
  const Scene& first = plies.front().scene;
  Symmetry common;  // planes and reasons
  common.asked = first.model.symmetry;
  std::vector<Symmetry> of_ply(plies.size());
  const std::size_t wanted = planes_wanted(common.asked);
  for (int axis = 0; axis < 2 && common.plane.size() < wanted; ++axis) {
    const SymmetryPlane plane = blank_plane(first.blank, axis);
    std::vector<MirrorMap> map(plies.size());
    std::string& why = common.why[axis];
    for (std::size_t k = 0; k < plies.size() && why.empty(); ++k) {
      why = difference(plies[k], tools, plane, axis, map[k]);
      if (!why.empty() && !plies[k].name.empty()) why = fmt::format("ply '{}': {}", plies[k].name, why);
    }
    if (!why.empty()) continue;
    common.plane.push_back(plane);
    for (std::size_t k = 0; k < plies.size(); ++k) of_ply[k].map.push_back(std::move(map[k]));
  }
  if (common.asked != SymmetryUse::automatic && common.plane.size() < wanted) refuse(first, common);
  for (Symmetry& own : of_ply) {
    own.plane = common.plane;
    own.why = common.why;
    own.asked = common.asked;
  }
  return of_ply;
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
