#include "mesher/lattice/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesher/lattice/cross.hpp"
#include "mesher/lattice/outline.hpp"

namespace weaveform::lattice {

namespace {

// Corners in units of half the frame's side, yarn coordinates, in order around from the base.
constexpr std::array<std::array<double, 2>, 4> corner_sign = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

// The frame's number of the corner that is number k to the yarns.
std::size_t frame_corner(int k, const FrameSpec& frame) {
  return static_cast<std::size_t>((k + frame.turn) % 4);
}

// The member that yarns of a family meet at their low or high end, as its two corners in order of the other axis.
std::array<int, 2> member(int family, int side) {
  if (family == 0) return side == 0 ? std::array<int, 2>{0, 3} : std::array<int, 2>{1, 2};
  return side == 0 ? std::array<int, 2>{0, 1} : std::array<int, 2>{3, 2};
}

void add_tied_arm(const YarnEnd& end, int family, const FrameSpec& frame, const BlankSpec& blank, const Card& card,
                  Mesh& mesh) {
  const int tied = add_arm(end, family, (end.side == 0 ? -0.5 : 0.5) * frame.length, blank, card, mesh);
  const Turn whole = turn_by_degrees(-blank.orientation - blank.yarn_angle);
  const auto& x = mesh.nodes.position[tied];
  const Vec2 place = whole.forward({x[0] - blank.position[0], x[1] - blank.position[1]});
  const auto [from, to] = member(family, end.side);
  mesh.tie.push_back({tied,
                      {mesh.frame.corner[frame_corner(from, frame)], mesh.frame.corner[frame_corner(to, frame)]},
                      place[1 - family] / frame.length + 0.5});
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

void attach_frame(const Scene& scene, const Card& card, Mesh& mesh) {
  const auto& frame = *scene.frame;
  const double member_mass = frame.density * frame.section * frame.length * frame.mass_scale;
  std::array<std::vector<YarnEnd>, 2> ends = {yarn_ends(mesh, 0), yarn_ends(mesh, 1)};
  for (int k = 0; k < 4; ++k)  // half of two members each
    mesh.frame.corner[frame_corner(k, frame)] =
        add_node(mesh, scene.blank, {0.5 * frame.length * corner_sign[k][0], 0.5 * frame.length * corner_sign[k][1]},
                 member_mass);
  for (int family = 0; family < 2; ++family)
    for (const auto& end : ends[family]) add_tied_arm(end, family, frame, scene.blank, card, mesh);
}

}  // namespace weaveform::lattice
