#include "mesher/lattice/cross.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace weaveform::lattice {
namespace {

// Yarn coordinates of a mesh node.
Vec2 yarn_coordinates(const BlankSpec& blank, const std::array<double, 3>& world) {
  const Turn whole = turn_by_degrees(-blank.orientation - blank.yarn_angle);
  return whole.forward({world[0] - blank.position[0], world[1] - blank.position[1]});
}

// The grip that takes an arm's end, by the edge it lies on (blank's frame) or by its box; -1: none.
int grip_at(const Scene& scene, const Vec2& end) {
  const Vec2 half = {0.5 * scene.blank.size[0], 0.5 * scene.blank.size[1]};
  const double near = 1e-9 * std::max(half[0], half[1]);
  const auto on = [&](double value, double limit) { return std::abs(value - limit) <= near; };
  for (std::size_t g = 0; g < scene.grip.size(); ++g) {
    const auto& grip = scene.grip[g];
    const bool on_edge = (grip.edge == BlankEdge::left && on(end[0], -half[0])) ||
                         (grip.edge == BlankEdge::right && on(end[0], half[0])) ||
                         (grip.edge == BlankEdge::bottom && on(end[1], -half[1])) ||
                         (grip.edge == BlankEdge::top && on(end[1], half[1]));
    const bool in_box = grip.box && end[0] >= (*grip.box)[0] - near && end[1] >= (*grip.box)[1] - near &&
                        end[0] <= (*grip.box)[2] + near && end[1] <= (*grip.box)[3] + near;
    if (on_edge || in_box) return static_cast<int>(g);
  }
  return -1;
}

}  // namespace

std::vector<YarnEnd> yarn_ends(const Mesh& mesh, int family) {
  std::vector<std::array<int, 2>> meeting(mesh.node_count(), {-1, -1});  // element that starts, that stops at a node
  for (int e = 0; e < mesh.yarn_count(); ++e) {
    if (static_cast<int>(mesh.yarns.family[e]) != family) continue;
    meeting[mesh.yarns.node[e][0]][0] = e;
    meeting[mesh.yarns.node[e][1]][1] = e;
  }
  std::vector<YarnEnd> ends;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const auto [starts, stops] = meeting[n];
    if (starts >= 0 && stops < 0) ends.push_back({starts, n, 0});
    if (stops >= 0 && starts < 0) ends.push_back({stops, n, 1});
  }
  return ends;
}

LineLayout lines_on_sides(const std::array<double, 2>& side, const Vec2& asked) {
  LineLayout lines;
  for (int axis = 0; axis < 2; ++axis) {
    const double count = std::max(1.0, std::round(side[axis] / asked[axis]));
    lines.spacing[axis] = side[axis] / count;
    // phase[0] moves the warp lines, which lie at constant second coordinate
    lines.phase[1 - axis] = std::fmod(count, 2.0) == 0.0 ? 0.0 : 0.5;
  }
  return lines;
}

int add_node(Mesh& mesh, const BlankSpec& blank, const Vec2& place, double mass) {
  const Turn yarns = turn_by_degrees(blank.yarn_angle);
  const Turn whole = turn_by_degrees(blank.orientation);
  const Vec2 p = whole.forward(yarns.forward(place));
  return mesh.nodes.add({blank.position[0] + p[0], blank.position[1] + p[1], blank.position[2]}, mass);
}

int add_arm(const YarnEnd& end, int family, double to, const BlankSpec& blank, const Card& card, Mesh& mesh) {
  const Vec2 start = yarn_coordinates(blank, mesh.nodes.position[end.node]);
  Vec2 stop = start;
  stop[family] = to;
  const double length = std::abs(stop[family] - start[family]);
  const double yarns = mesh.yarns.yarns[end.element];
  const double half_mass = 0.5 * yarns * card.yarn[family].linear_density * length;
  const int added = add_node(mesh, blank, stop, half_mass);
  mesh.nodes.mass[end.node] += half_mass;
  mesh.yarns.add({.node = end.side == 0 ? std::array<int, 2>{added, end.node} : std::array<int, 2>{end.node, added},
                  .family = static_cast<Family>(family),
                  .rest_length = length,
                  .section = mesh.yarns.section[end.element],
                  .yarns = yarns});
  return added;
}

void check_cross(const Scene& scene, std::vector<std::string>& complaints) {
  const auto& blank = scene.blank;
  if (std::abs(std::remainder(blank.yarn_angle, 90.0)) > 1e-9)
    complaints.push_back(fmt::format("blank.yarn_angle: {} deg; the yarns of a cross run along its arms, set 0 or 90",
                                     blank.yarn_angle));
  if (*blank.arm_width >= std::min(blank.size[0], blank.size[1]))
    complaints.push_back(fmt::format("blank.arm_width: {} mm leaves no arms on a cross of {} x {} mm; make it smaller",
                                     *blank.arm_width, blank.size[0], blank.size[1]));
  if (scene.frame) complaints.push_back("blank.shape: a shear frame makes its own arms; set shape = \"rectangle\"");
}

void attach_cross(const Scene& scene, const Card& card, Mesh& mesh) {
  const BlankSpec& blank = scene.blank;
  const Turn yarns = turn_by_degrees(blank.yarn_angle);
  // the blank's axis that a family runs along: yarn_angle is a multiple of 90
  const std::array<Vec2, 2> along = {yarns.forward({1.0, 0.0}), yarns.forward({0.0, 1.0})};
  const std::array<std::vector<YarnEnd>, 2> ends = {yarn_ends(mesh, 0), yarn_ends(mesh, 1)};
  for (int family = 0; family < 2; ++family) {
    const double reach = 0.5 * (std::abs(along[family][0]) > 0.5 ? blank.size[0] : blank.size[1]);
    for (const auto& end : ends[family]) {
      const int tip = add_arm(end, family, end.side == 0 ? -reach : reach, blank, card, mesh);
      const int grip = grip_at(scene, yarns.forward(yarn_coordinates(blank, mesh.nodes.position[tip])));
      if (grip < 0) continue;
      for (auto& set : mesh.sets)
        if (set.name == scene.grip[grip].name) set.node.push_back(tip);
    }
  }
}

}  // namespace weaveform::lattice
