// The feet of a ply's nodes on another: how they are found, go from cell to cell, leave the surface and come back.
#include <algorithm>
#include <limits>

#include "solver/contact/ply_pass.hpp"

namespace weaveform {
namespace {

// Of a cell: a foot is off the ply when it is so far out. Triangles, small and at free corners, do not go on far.
constexpr double ply_border = 0.3, triangle_border = 0.05;
constexpr double beside_the_ply = 0.02;  // of a cell: no foot goes so far out of its cell in a step
constexpr double come_back_part = 0.2;  // of the softening depth: how much deeper than its neighbours a foot comes back

}  // namespace

// From one node to the next the foot moves by about a cell, so that only the first of all is looked for everywhere.
SurfacePlace PlyPassState::start_of_search(int lane, const SurfacePlace& before) const {
  const int node = own_.node_of(lane), south = own_.arms(node).arm[2], beside = own_.lane_of(south);
  if (south < node && beside >= 0 && facet_[beside] >= 0) return place_of(beside);
  if (before.facet >= 0) return before;
  return other_.surface().nearest_middle(own_.position(node), other_.state().position);
}

double PlyPassState::search(std::vector<double>* depths) {
  wake();
  if (depths != nullptr) depths->assign(own_.nodes(), no_depth);
  const PlySurface& surface = other_.surface();
  const auto& position = other_.state().position;
  double least_gap = std::numeric_limits<double>::infinity();
  SurfacePlace before;
  for (std::size_t b = 0; b < own_.blocks().size(); ++b) {
    const PlyBlock& block = own_.blocks()[b];
    double deepest = no_depth;
    for (int l = block.at; l < block.at + block.count; ++l) {
      const int node = own_.node_of(l);
      const Vec3 x = own_.position(node), normal = own_.normal(node);
      SurfacePlace place = start_of_search(l, before);
      if (place.facet < 0) break;  // a surface without cells
      if (!surface.follow(place, x, normal, position)) {
        place = surface.nearest_middle(x, position);
        if (!surface.follow(place, x, normal, position)) continue;
      }
      before = place;
      put(l, place);
      if (surface.outside(place) > cell_border) continue;
      const double depth = depth_at(l, place, normal);
      turn_on(l, place, depth);
      deepest = std::max(deepest, depth);
      if (depths != nullptr) (*depths)[node] = depth;
    }
    count_off(static_cast<int>(b));
    least_gap = std::min({least_gap, clearance(static_cast<int>(b), deepest), touch_ - deepest});
  }
  return least_gap;
}

// Whether the line along the node's normal meets the surface as the kernel wants it, less than 60 degrees off, and not
// on another side of a fold.
bool PlyPassState::faces(int lane, const SurfacePlace& place) const {
  const Vec3 n = own_.normal(own_.node_of(lane));
  const Frame frame = frame_at(place);
  const Vec3 m = cross(frame.s1, frame.s2);
  const double along = dot(m, n);
  return along > 0.0 && 4.0 * along * along > dot(m, m) * dot(n, n) && depth_at(lane, place, n) < 2.0 * law_.reach;
}

// A foot that was off, beside the ply or in a fold, comes back where hardly anything happens by that: no deeper than its
// neighbours' have been pressed. Deeper, a spring that nobody has pressed would push it.
bool PlyPassState::may_come_back(int lane, const SurfacePlace& place) const {
  if (!faces(lane, place)) return false;
  const int node = own_.node_of(lane);
  double pressed = 0.0;
  for (const int beside : own_.arms(node).arm)
    if (const int l = own_.lane_of(beside); l >= 0 && stiffness_[l] > 0.0) pressed = std::max(pressed, depth_[l]);
  return depth_at(lane, place, own_.normal(node)) < pressed + come_back_part * law_.softening;
}

// Whether a foot beside the ply still counts as on it.
bool PlyPassState::holds_on(const SurfacePlace& place) const {
  return other_.surface().is_triangle(place.facet) ? other_.surface().outside(place) <= triangle_border
                                                   : other_.surface().away(place) <= ply_border;
}

// To the next cell before anything acts: on a cell left behind the depth is another, and the step to the next one would
// come with energy from nowhere. Off the ply, or along its edge, it has time.
void PlyPassState::move_feet(int number, const PlyPassNodes& nodes, PlyFeet& feet, bool tidies) {
  const PlySurface& surface = other_.surface();
  const PlyBlock& block = own_.blocks()[number];
  for (int i = 0; i < block.count; ++i) {
    const int l = block.at + i;
    if (stiffness_[l] == 0.0) continue;
    const SurfacePlace now = place_of(l);
    if (tidies && !faces(l, now)) {
      turn_off(l);
      continue;
    }
    // far out it has been beside the ply for some time
    const double out = surface.outside(now);
    if (out <= cell_border || (!tidies && out > beside_the_ply)) continue;
    SurfacePlace next = surface.find(surface.material(now));
    if (next.facet < 0) {
      if (!tidies) continue;
      next = surface.near(surface.material(now));
      if (next.facet < 0 || !holds_on(next) || surface.away(now) <= surface.away(next)) {
        if (!holds_on(now)) turn_off(l);
        continue;  // the nearest already
      }
    }
    if (next.facet == now.facet) continue;
    carry_over(l, now, next, {feet.dxi[i], feet.deta[i]});
    (void)find_one(number, nodes, feet, i);
  }
  count_off(number);
}

// Everything that is kept in a facet's coordinates, and the foot to where it was before it made this way.
void PlyPassState::carry_over(int lane, const SurfacePlace& from, const SurfacePlace& to, const Vec2& way) {
  const PlySurface& surface = other_.surface();
  const Vec2 stretch =
      surface.carried_over({from.xi - anchor_[0][lane], from.eta - anchor_[1][lane]}, from.facet, to.facet);
  const Vec2 drag = surface.carried_over({drag_[1][lane], drag_[2][lane]}, from.facet, to.facet);
  const Vec2 way_there = surface.carried_over(way, from.facet, to.facet);
  put(lane, to);
  for (std::size_t k = 0; k < 2; ++k) {
    anchor_[k][lane] = place_[k][lane] - stretch[k];
    drag_[k + 1][lane] = drag[k];
    place_[k][lane] -= way_there[k];
  }
  set_corner(lane);
}

// After steps without a look feet may be anywhere; nothing is stretched where nothing touched.
void PlyPassState::find_again(int number) {
  const PlyBlock& block = own_.blocks()[number];
  for (int l = block.at; l < block.at + block.count; ++l)
    if (facet_[l] >= 0) turn_off(l);
  find_lost(number);
}

// Feet that are off, from where they left or from where a neighbour's is. First all are found, then those come back that
// may: none because of another that has only just come.
void PlyPassState::find_lost(int number) {
  const PlySurface& surface = other_.surface();
  const PlyBlock& block = own_.blocks()[number];
  std::array<int, ply_nodes_at_a_time> back{};
  int count = 0;
  for (int l = block.at; l < block.at + block.count; ++l) {
    if (stiffness_[l] > 0.0) continue;
    const int node = own_.node_of(l);
    SurfacePlace place = place_of(l);
    for (const int beside : own_.arms(node).arm)
      if (place.facet < 0 && own_.lane_of(beside) >= 0) place = place_of(own_.lane_of(beside));
    if (place.facet < 0) continue;
    if (!surface.follow(place, own_.position(node), own_.normal(node), other_.state().position)) continue;
    put(l, place);
    if (surface.outside(place) <= cell_border && may_come_back(l, place)) back[count++] = l;
  }
  for (int k = 0; k < count; ++k) {
    const SurfacePlace place = place_of(back[k]);
    turn_on(back[k], place, depth_at(back[k], place, own_.normal(own_.node_of(back[k]))));
  }
  count_off(number);
}

}  // namespace weaveform
