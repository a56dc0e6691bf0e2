#include "solver/contact/rounded_edges.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/ply_kernel.hpp"

namespace weaveform {
namespace {

// rad; a force that turns by less hardly misses the work of the step it turns in, and the surface that is rounded from
// there on moves by 1e-4 of the thickness
constexpr double least_angle = 0.01;
constexpr double part_of_thickness = 0.05;  // w
constexpr double widest = 0.1;              // cells; b
constexpr int ways_round = 9;               // places of a ring

bool has(unsigned quads, unsigned both) {
  return (quads & both) == both;
}

// Whether the line between these pairs of quads is an edge where a place lies that has `own` beside it and, next to the
// crossing, `other` too: what a border interrupts has no way to go on.
bool is_edge(unsigned quads, unsigned own, unsigned other, bool reaches_other) {
  return has(quads, own) && (!reaches_other || has(quads, other) || (quads & other) == 0);
}

}  // namespace

RoundedEdges::RoundedEdges(const Ply& ply, const PlySurface& surface)
    : surface_(surface),
      rings_(ply),
      border_{std::min(part_of_thickness * ply.mesh().thickness / ply.mesh().spacing[0], widest),
              std::min(part_of_thickness * ply.mesh().thickness / ply.mesh().spacing[1], widest)},
      least_square_(std::pow(least_angle * std::min(ply.mesh().spacing[0], ply.mesh().spacing[1]), 2)),
      greatest_change_(2.0 * part_of_thickness * ply.mesh().thickness),
      bent_(rings_.size(), 0) {}

// The angle of an edge times a cell's length is the second difference of the crossings across it, out of the plane.
int RoundedEdges::bent_at(int node, const Components& position) const {
  const unsigned quads = rings_.quads(node);
  if (quads == 0) return 0;
  const auto place_of = [&](int place) { return rings_.position(rings_.at(node, place), position); };
  const Vec3 south = place_of(1), west = place_of(3), here = place_of(4), east = place_of(5), north = place_of(7);
  const Vec3 normal = cross(minus(east, west), minus(north, south));
  const auto rises = [&](const Vec3& before, const Vec3& after) {
    const double out = dot(minus(plus(before, after), scaled(here, 2.0)), normal);
    return out * out > least_square_ * dot(normal, normal);
  };
  const bool columns = has(quads, south_west | south_east) || has(quads, north_west | north_east),
             rows = has(quads, south_west | north_west) || has(quads, south_east | north_east);
  return (columns && rises(west, east) ? 1 : 0) | (rows && rises(south, north) ? 2 : 0);
}

// A foot asks only the crossing next to it: what is bent at one counts a cell further along its line.
void RoundedEdges::look(const Components& position) {
  const int count = rings_.size(), stride = rings_.stride();
  std::vector<int> here(count);
  for (int node = 0; node < count; ++node) here[node] = bent_at(node, position);
  any_ = std::any_of(here.begin(), here.end(), [](int bent) { return bent != 0; });
  bent_ = here;
  if (!any_) return;
  for (int node = 0; node < count; ++node)
    for (const auto& [way, bit] : {std::pair{stride, 1}, {-stride, 1}, {1, 2}, {-1, 2}})
      if (node + way >= 0 && node + way < count) bent_[node] |= here[node + way] & bit;
}

EdgePlace RoundedEdges::find_near(const SurfacePlace& place) const {
  if (surface_.is_triangle(place.facet)) return no_edge;
  // where the place lies as seen from the crossing next to it
  const bool west = place.xi > 0.5, south = place.eta > 0.5;
  const int node = place.facet + (west ? 1 : 0) + (south ? rings_.stride() : 0);
  const Vec2 from = {west ? place.xi - 1.0 : place.xi, south ? place.eta - 1.0 : place.eta};
  const bool near_column = std::abs(from[0]) < border_[0], near_row = std::abs(from[1]) < border_[1];
  const unsigned quads = rings_.quads(node), bent = static_cast<unsigned>(bent_[node]);
  const unsigned row = south ? south_west | south_east : north_west | north_east,
                 column = west ? south_west | north_west : south_east | north_east;
  const bool over_column = near_column && (bent & 1U) != 0 && is_edge(quads, row, all_four & ~row, near_row),
             over_row = near_row && (bent & 2U) != 0 && is_edge(quads, column, all_four & ~column, near_column);
  if (!over_column && !over_row) return no_edge;
  const auto chord = [](bool before) { return before ? on_chord_before : on_chord_after; };
  return {node, from, {over_column ? border_[0] : chord(west), over_row ? border_[1] : chord(south)}};
}

void RoundedEdges::put(const EdgePlace& edge, SurfacePlace& place) const {
  const int stride = rings_.stride(), columns = edge.crossing % stride - place.facet % stride,
            rows = edge.crossing / stride - place.facet / stride;
  place.xi = edge.from[0] + columns;
  place.eta = edge.from[1] + rows;
}

SurfaceFrame RoundedEdges::frame(const SurfacePlace& place, const Components& position) const {
  const EdgePlace edge = find(place);
  if (edge.crossing < 0) return surface_.frame(place, position);
  EdgeFeet feet;
  fill(edge, position, 0, feet);
  for (auto& x : feet.x) x[0] = 0.0;
  for (auto& n : feet.n) n[0] = 0.0;
  loops_of_edges().find(fill_up(1, feet), 0, feet);
  SurfaceFrame frame{};
  for (std::size_t c = 0; c < 3; ++c) {
    frame.point[c] = -feet.r[c][0];  // x = 0
    frame.s1[c] = feet.s1[c][0];
    frame.s2[c] = feet.s2[c][0];
  }
  return frame;
}

void RoundedEdges::fill(const EdgePlace& edge, const Components& position, int lane, EdgeFeet& feet) const {
  for (std::size_t k = 0; k < 2; ++k) {
    feet.place[k][lane] = edge.from[k];
    feet.border[k][lane] = edge.border[k];
  }
  if (rings_.special(edge.crossing) == nullptr) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b) {
        const double* const row =
            position[c].data() + edge.crossing + static_cast<std::ptrdiff_t>(b - 1) * rings_.stride();
        for (int a = 0; a < 3; ++a) feet.crossing[c][3 * b + a][lane] = row[a - 1];
      }
    return;
  }
  for (int k = 0; k < ways_round; ++k) {
    const Vec3 x = rings_.position(rings_.at(edge.crossing, k), position);
    for (std::size_t c = 0; c < 3; ++c) feet.crossing[c][k][lane] = x[c];
  }
}

int RoundedEdges::fill_up(int count, EdgeFeet& feet) {
  const int end = (count + ply_nodes_padded_to - 1) / ply_nodes_padded_to * ply_nodes_padded_to;
  const auto fill_lanes = [count, end](auto& lanes) { std::fill(lanes + count, lanes + end, lanes[0]); };
  for (auto& component : feet.crossing)
    for (auto& one : component) fill_lanes(one);
  for (auto* vectors : {&feet.x, &feet.n})
    for (auto& component : *vectors) fill_lanes(component);
  for (auto* pairs : {&feet.border, &feet.place})
    for (auto& one : *pairs) fill_lanes(one);
  return end;
}

void RoundedEdges::give_back(const EdgePlace& edge, const EdgeFeet& feet, int lane, const Vec3& force, double* into,
                             char* touched) const {
  for (int k = 0; k < ways_round; ++k) {
    const double weight = feet.weight[0][k % 3][lane] * feet.weight[1][k / 3][lane];
    if (weight == 0.0) continue;
    const RingCrossing at = rings_.at(edge.crossing, k);
    const Vec3 taken = at.planes == 0 ? force : rings_.mirrored(force, at.planes);
    for (int c = 0; c < 3; ++c) into[4 * static_cast<std::size_t>(at.node) + c] -= weight * taken[c];
    touched[at.node / ply_segment] = 1;
  }
}

void RoundedEdges::archive(Archive& archive) {
  archive.indices("whether cells meet at an angle", bent_, 0, 3);
  any_ = std::any_of(bent_.begin(), bent_.end(), [](int bent) { return bent != 0; });
}

}  // namespace weaveform
