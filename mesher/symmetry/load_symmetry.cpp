#include "mesher/symmetry/load_symmetry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/vector/vector.hpp"
#include "mesher/lattice/outline.hpp"
#include "mesher/scene/grip_direction.hpp"
#include "mesher/tools/tool.hpp"

namespace weaveform {
namespace {

constexpr double place_rounding = 1e-9;       // mm; a tool this near to the plane is in it
constexpr double direction_rounding = 1e-12;  // 1; of a unit vector's component

std::string gravity_difference(const Scene& scene, const SymmetryPlane& plane) {
  const Vec3& gravity = scene.analysis.gravity;
  const double size = plain_length(gravity);
  return std::abs(dot(gravity, plane.normal)) > direction_rounding * size ? "gravity pulls across it" : "";
}

BlankEdge mirrored_edge(BlankEdge edge, int axis) {
  constexpr std::array<std::array<BlankEdge, 2>, 2> opposite = {
      {{BlankEdge::left, BlankEdge::right}, {BlankEdge::bottom, BlankEdge::top}}};
  if (edge == opposite[axis][0]) return opposite[axis][1];
  return edge == opposite[axis][1] ? opposite[axis][0] : edge;
}

bool holds_the_image(const GripSpec& grip, const GripSpec& other, int axis) {
  if (!grip.box || !other.box)
    return !grip.box && !other.box && grip.edge && other.edge == mirrored_edge(*grip.edge, axis);
  auto box = *grip.box;  // xmin, ymin, xmax, ymax
  std::swap(box[axis], box[axis + 2]);
  box[axis] = -box[axis];
  box[axis + 2] = -box[axis + 2];
  for (std::size_t k = 0; k < 4; ++k)
    if (std::abs(box[k] - (*other.box)[k]) > place_rounding) return false;
  return true;
}

// A grip at rest may point anywhere: its force across the plane is zero.
std::string grip_difference(const GripSpec& grip, const GripSpec& image, int axis) {
  Vec3 mirrored = grip_direction(grip);
  const Vec3 direction = grip_direction(image);
  mirrored[axis] = -mirrored[axis];
  double off = 0.0;
  for (std::size_t c = 0; c < 3; ++c) off = std::max(off, std::abs(mirrored[c] - direction[c]));
  const bool same = grip.name == image.name;
  const std::string names =
      same ? fmt::format("grip '{}'", grip.name) : fmt::format("grips '{}' and '{}'", grip.name, image.name);
  if (off > direction_rounding && !(same && grip.travel == 0.0))
    return names + (same ? " pulls across it" : " do not pull in mirrored directions");
  const auto freedoms = [](const GripSpec& g) {
    auto free = g.free;
    std::sort(free.begin(), free.end());
    return free;
  };
  if (grip.travel != image.travel || freedoms(grip) != freedoms(image)) return names + " differ in travel or freedom";
  return "";
}

std::string grips_difference(const Scene& scene, int axis) {
  for (const auto& grip : scene.grip) {
    const auto image = std::find_if(scene.grip.begin(), scene.grip.end(),
                                    [&](const GripSpec& other) { return holds_the_image(grip, other, axis); });
    if (image == scene.grip.end()) return fmt::format("grip '{}' has none like it opposite", grip.name);
    const std::string why = grip_difference(grip, *image, axis);
    if (!why.empty()) return why;
  }
  return "";
}

// All analytic tools are solids of revolution about their axis.
bool shape_is_mirrored(const Tool& tool, const SymmetryPlane& plane) {
  const Vec3 off = {tool.start.origin[0] - plane.point[0], tool.start.origin[1] - plane.point[1],
                    tool.start.origin[2] - plane.point[2]};
  const bool in_plane = std::abs(dot(off, plane.normal)) <= place_rounding;
  const double across = std::abs(dot(tool.start.axis, plane.normal));
  const bool along = across <= direction_rounding;
  switch (tool.shape) {
    case ToolShape::plane:
      return along;
    case ToolShape::cylinder:
      return (along && in_plane) || across >= 1.0 - direction_rounding;  // endless both ways
    case ToolShape::sphere:
    case ToolShape::ring:
    case ToolShape::revolved:
      return along && in_plane;
    case ToolShape::triangles:
      return false;
  }
  return false;
}

std::string tools_difference(const Scene& scene, const std::vector<Tool>& tools, const SymmetryPlane& plane) {
  for (const auto& spec : scene.tools)
    if (spec.shape == ToolShape::triangles)
      return fmt::format("tool '{}' is made of triangles, whose symmetry is not looked for", spec.name);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    const ToolSpec& spec = scene.tools[t];
    const std::string name = fmt::format("tool '{}'", spec.name);
    if (!shape_is_mirrored(tools[t], plane)) return name + " stands to one side of it or leans across it";
    const bool moves = spec.travel != 0.0 || spec.force;
    if (moves && std::abs(dot(tools[t].direction, plane.normal)) > direction_rounding) return name + " moves across it";
  }
  return "";
}

}  // namespace

SymmetryPlane blank_plane(const BlankSpec& blank, int axis) {
  const auto turn = lattice::turn_by_degrees(blank.orientation);
  const auto normal = turn.forward(axis == 0 ? Vec2{1.0, 0.0} : Vec2{0.0, 1.0});
  return {blank.position, {normal[0], normal[1], 0.0}};
}

std::string find_load_difference(const Scene& scene, const std::vector<Tool>& tools, int axis) {
  const SymmetryPlane plane = blank_plane(scene.blank, axis);
  if (scene.frame) return "a shear frame holds the fabric";
  if (scene.drape) return "the blank starts draped";
  if (scene.analysis.perturbation > 0.0) return "analysis.perturbation is random";
  std::string why = gravity_difference(scene, plane);
  if (why.empty()) why = grips_difference(scene, axis);
  if (why.empty()) why = tools_difference(scene, tools, plane);
  return why;
}

std::string find_law_difference(const Scene& scene, const Card& card, const MirrorMap& map) {
  const auto& model = scene.model;
  // Elements have to know of mirror planes: the rotations of a shell's directors do not.
  if (model.cell == CellElement::shell) return "shell cells have no mirror planes";
  if (card.shear.tension_coupling > 0.0)
    return "the card couples tension and shear, which is solved on the whole blank";
  if (!map.swaps_families) return "";
  if (!(card.yarn[0] == card.yarn[1])) return "it swaps warp and weft, whose yarns differ";
  const auto differs = [](const auto& rigidity) { return rigidity && (*rigidity)[0] != (*rigidity)[1]; };
  if (model.cell != CellElement::membrane &&
      (model.cell_bending ? differs(model.cell_bending) : differs(card.bending.rigidity)))
    return "it swaps warp and weft, along which the cells bend differently";
  if (model.formulation == Formulation::side_frame)
    return "it swaps warp and weft, and the side frame follows the warp";
  return "";
}

}  // namespace weaveform
