// The feet of a ply's nodes on another: how they are found, go from cell to cell, leave the surface and come back.
#include <algorithm>
#include <limits>

#include "solver/contact/nearest_facet.hpp"
#include "solver/contact/ply_pass.hpp"

namespace weaveform {
namespace {

// Of a cell: a foot is off the ply when it is so far out. Triangles, small and at free corners, do not go on far.
constexpr double ply_border = 0.3, triangle_border = 0.05;
constexpr double beside_the_ply = 0.02;  // of a cell: no foot goes so far out of its cell in a step
constexpr double beside_not_far =
    1.0;  // cells; a foot so near to the ply is beside it, and not over the other side of a hole
constexpr double come_back_part = 0.2;  // of the softening depth: how much deeper than its neighbours a foot comes back

}  // namespace

// From where it was. At first from a row to the next, for the foot moves by about a cell; where there is none to start
// from, or the way from there leads off the ply (over a hole, or from beside it), from the facet that is nearest now. A
// way of hundreds of cells would be no start: it ends somewhere, and the first step along the wrong cell's slope in
// another ply.
SurfacePlace PlyPassState::place_found(int lane, std::optional<NearestFacet>& nearest) const {
  const PlySurface& surface = other_.surface();
  const auto& position = other_.state().position;
  if (facet_[lane] >= 0)
    if (const SurfacePlace again = place_again(lane); again.facet >= 0) return again;
  const int node = own_.node_of(lane), south = own_.arms(node).arm[2], beside = own_.lane_of(south);
  const Vec3 x = own_.position(node), normal = own_.normal(node);
  SurfacePlace place;
  if (south < node && beside >= 0) place = place_of(beside);
  if (place.facet >= 0 && surface.follow(place, x, normal, position) && surface.outside(place) <= cell_border)
    return place;
  if (!nearest) nearest.emplace(surface, position);
  place = (*nearest)(x);
  return place.facet >= 0 && surface.follow(place, x, normal, position) ? place : SurfacePlace{};
}

double PlyPassState::search(std::vector<double>* depths) {
  wake();
  if (depths != nullptr) depths->assign(own_.nodes(), no_depth);
  std::optional<NearestFacet> nearest;  // costs as much as many feet
  double least_gap = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < own_.blocks().size(); ++b) {
    const PlyBlock& block = own_.blocks()[b];
    double deepest = no_depth;
    for (int l = block.at; l < block.at + block.count; ++l) {
      const int node = own_.node_of(l);
      const SurfacePlace place = place_found(l, nearest);
      put(l, place);
      if (place.facet < 0 || other_.surface().outside(place) > cell_border) continue;
      const double depth = depth_at(l, place, own_.normal(node));
      turn_on(l, place, depth);
      deepest = std::max(deepest, depth);
      if (depths != nullptr) (*depths)[node] = depth;
    }
    count_off(static_cast<int>(b));
    least_gap = std::min({least_gap, clearance(static_cast<int>(b), deepest, 0.0), touch_ - deepest});
  }
  return least_gap;
}

// Whether the line along the node's normal meets the surface as the kernel wants it, less than 60 degrees off, and not
// on another side of a fold.
bool PlyPassState::faces(int lane, const SurfacePlace& place) const {
  const Vec3 n = own_.normal(own_.node_of(lane));
  const SurfaceFrame frame = frame_at(place);
  const Vec3 m = cross(frame.s1, frame.s2);
  const double along = dot(m, n);
  return along > 0.0 && 4.0 * along * along > dot(m, m) * dot(n, n) &&
         depth_at(lane, place, n) < 2.0 * reach_at(lane, place);
}

// A foot that was off, beside the ply or in a fold, comes back where hardly anything happens by that: no deeper than its
// neighbours' have been pressed. Deeper, a spring that nobody has pressed would push it.
bool PlyPassState::may_come_back(int lane, const SurfacePlace& place) const {
  if (!faces(lane, place)) return false;
  double pressed = 0.0;
  for (const int l : own_.lanes_beside(lane))
    if (l >= 0 && stiffness_[l] > 0.0) pressed = std::max(pressed, depth_[l]);
  return depth_at(lane, place, own_.normal(own_.node_of(lane))) < pressed + come_back_part * law_.softening;
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

// From where it left, or, when that is far from the ply by now or leads nowhere, from where a neighbour's is; off the ply
// where neither leads onto it.
SurfacePlace PlyPassState::place_again(int lane) const {
  const PlySurface& surface = other_.surface();
  const int node = own_.node_of(lane);
  const Vec3 x = own_.position(node), normal = own_.normal(node);
  SurfacePlace off;
  const auto leads_on = [&](SurfacePlace& place) {
    if (place.facet < 0 || !surface.follow(place, x, normal, other_.state().position)) return false;
    if (surface.outside(place) <= cell_border) return true;
    if (off.facet < 0) off = place;
    return false;
  };
  if (SurfacePlace own = place_of(lane); leads_on(own)) return own;
  if (off.facet >= 0 && surface.away(off) < beside_not_far) return off;
  for (const int l : own_.lanes_beside(lane))
    if (l >= 0)
      if (SurfacePlace theirs = place_of(l); leads_on(theirs)) return theirs;
  return off;
}

// Feet that are off. First all are found, then those come back that
// may: none because of another that has only just come.
void PlyPassState::find_lost(int number) {
  const PlySurface& surface = other_.surface();
  const PlyBlock& block = own_.blocks()[number];
  std::array<int, ply_nodes_at_a_time> back{};
  int count = 0;
  for (int l = block.at; l < block.at + block.count; ++l) {
    if (stiffness_[l] > 0.0) continue;
    const SurfacePlace place = place_again(l);
    if (place.facet < 0) continue;
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
