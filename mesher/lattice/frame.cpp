#include "mesher/lattice/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesher/lattice/outline.hpp"

namespace weaveform::lattice {

namespace {

// Corners in units of half the frame's side, yarn coordinates, in order around from the base.
constexpr std::array<std::array<double, 2>, 4> corner_sign = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

int add_node(Mesh& mesh, const BlankSpec& blank, const Vec2& place, double mass) {
  const Turn yarns = turn_by_degrees(blank.yarn_angle);
  const Turn whole = turn_by_degrees(blank.orientation);
  const Vec2 p = whole.forward(yarns.forward(place));
  mesh.nodes.position.push_back({blank.position[0] + p[0], blank.position[1] + p[1], blank.position[2]});
  mesh.nodes.mass.push_back(mass);
  mesh.nodes.crossing.push_back({-1, -1});
  return mesh.node_count() - 1;
}

// Where a yarn line stops: its last element there, the node, and whether that is the line's low or high end.
struct YarnEnd {
  int element = 0;
  int node = 0;
  int side = 0;  // 0 low, 1 high, along the family's axis
};

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

// The member that yarns of a family meet at their low or high end, as its two corners in order of the other axis.
std::array<int, 2> member(int family, int side) {
  if (family == 0) return side == 0 ? std::array<int, 2>{0, 3} : std::array<int, 2>{1, 2};
  return side == 0 ? std::array<int, 2>{0, 1} : std::array<int, 2>{3, 2};
}

// Yarn coordinates of a mesh node.
Vec2 yarn_coordinates(const BlankSpec& blank, const std::array<double, 3>& world) {
  const Turn whole = turn_by_degrees(-blank.orientation - blank.yarn_angle);
  return whole.forward({world[0] - blank.position[0], world[1] - blank.position[1]});
}

void add_arm(const YarnEnd& end, int family, const FrameSpec& frame, const BlankSpec& blank, const Card& card,
             Mesh& mesh) {
  const Vec2 start = yarn_coordinates(blank, mesh.nodes.position[end.node]);
  Vec2 stop = start;
  stop[family] = (end.side == 0 ? -0.5 : 0.5) * frame.length;
  const double length = std::abs(stop[family] - start[family]);
  const double yarns = mesh.yarns.yarns[end.element];
  const double half_mass = 0.5 * yarns * card.yarn[family].linear_density * length;
  const int tied = add_node(mesh, blank, stop, half_mass);
  mesh.nodes.mass[end.node] += half_mass;
  mesh.yarns.node.push_back(end.side == 0 ? std::array<int, 2>{tied, end.node} : std::array<int, 2>{end.node, tied});
  mesh.yarns.family.push_back(static_cast<Family>(family));
  mesh.yarns.rest_length.push_back(length);
  mesh.yarns.section.push_back(mesh.yarns.section[end.element]);
  mesh.yarns.yarns.push_back(yarns);
  mesh.yarns.jaw.push_back(0.0);
  mesh.yarns.softening.push_back(1.0);
  const auto [from, to] = member(family, end.side);
  mesh.tie.push_back({tied, {mesh.frame.corner[from], mesh.frame.corner[to]}, stop[1 - family] / frame.length + 0.5});
}

}  // namespace

void check_frame(const Scene& scene, std::vector<std::string>& complaints) {
  const auto& blank = scene.blank;
  if (std::abs(blank.size[0] - blank.size[1]) > 1e-9 * blank.size[0])
    complaints.push_back(
        fmt::format("blank.size: a shear frame takes a square, not {} x {} mm", blank.size[0], blank.size[1]));
  if (std::abs(std::remainder(blank.yarn_angle, 90.0)) > 1e-9)
    complaints.push_back(fmt::format(
        "blank.yarn_angle: {} deg; in a shear frame the yarns run along the members, set 0", blank.yarn_angle));
  if (scene.frame->length <= std::max(blank.size[0], blank.size[1]))
    complaints.push_back(fmt::format("frame.length: {} mm leaves no arms around a blank of {} mm; make it longer",
                                     scene.frame->length, blank.size[0]));
  if (!scene.grip.empty())
    complaints.push_back("grip: a shear frame holds the fabric by itself; remove [[grip]] or [frame]");
}

LineLayout frame_lines(const BlankSpec& blank, const Vec2& asked) {
  LineLayout lines;
  for (int axis = 0; axis < 2; ++axis) {
    const double count = std::max(1.0, std::round(blank.size[axis] / asked[axis]));
    lines.spacing[axis] = blank.size[axis] / count;
    // phase[0] moves the warp lines, which lie at constant second coordinate
    lines.phase[1 - axis] = std::fmod(count, 2.0) == 0.0 ? 0.0 : 0.5;
  }
  return lines;
}

void attach_frame(const Scene& scene, const Card& card, Mesh& mesh) {
  const auto& frame = *scene.frame;
  const double member_mass = frame.density * frame.section * frame.length * frame.mass_scale;
  std::array<std::vector<YarnEnd>, 2> ends = {yarn_ends(mesh, 0), yarn_ends(mesh, 1)};
  for (std::size_t k = 0; k < 4; ++k)  // half of two members each
    mesh.frame.corner[k] =
        add_node(mesh, scene.blank, {0.5 * frame.length * corner_sign[k][0], 0.5 * frame.length * corner_sign[k][1]},
                 member_mass);
  for (int family = 0; family < 2; ++family)
    for (const auto& end : ends[family]) add_arm(end, family, frame, scene.blank, card, mesh);
}

}  // namespace weaveform::lattice
