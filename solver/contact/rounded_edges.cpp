#include "solver/contact/rounded_edges.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/ply_kernel.hpp"

namespace weaveform {
namespace {

// rad; a force that turns by less hardly misses the work of the step it turns in, and the surface that is rounded from
// there on moves by 1e-5 of a cell
constexpr double least_angle = 0.01;

// Quads around a crossing.
constexpr unsigned south_west = 1, south_east = 2, north_west = 4, north_east = 8, all_four = 15;

}  // namespace

RoundedEdges::RoundedEdges(const Mesh& mesh, const PackedMesh& packed, const PlySurface& surface)
    : surface_(surface),
      plane_(mesh.symmetry.plane),
      stride_(packed.stride),
      rows_(packed.rows),
      least_square_(std::pow(least_angle * std::min(mesh.spacing[0], mesh.spacing[1]), 2)),
      greatest_change_(rounded_within * std::max(mesh.spacing[0], mesh.spacing[1])),
      exists_(packed.lattice_nodes(), 0),
      quads_(packed.lattice_nodes(), 0),
      irregular_(packed.lattice_nodes(), -1),
      bent_(packed.lattice_nodes(), 0),
      bent_here_(packed.lattice_nodes(), 0) {
  for (const int node : packed.packed_of_mesh)
    if (node < packed.lattice_nodes()) exists_[node] = 1;
  for (unsigned planes = 0; planes < 1U << plane_.size(); ++planes) {
    mirror_.push_back(reflection(plane_, planes));
    Vec3 origin = {0.0, 0.0, 0.0};
    for (std::size_t k = 0; k < plane_.size(); ++k)
      if ((planes >> k & 1U) != 0) origin = mirrored_point(origin, plane_[k]);
    mirrored_origin_.push_back(origin);
  }
  find_reflections(mesh);
  find_rings();
}

// From the crossings that lie in a plane.
void RoundedEdges::find_reflections(const Mesh& mesh) {
  reflection_.resize(plane_.size());
  for (std::size_t k = 0; k < plane_.size(); ++k) {
    std::vector<std::array<int, 2>> on;
    for (const int n : mesh.symmetry.on_plane[k])
      if (mesh.nodes.crossing[n][0] >= 0) on.push_back(mesh.nodes.crossing[n]);
    if (on.size() < 2) continue;
    const int di = on[1][0] - on[0][0], dj = on[1][1] - on[0][1];
    Reflection& found = reflection_[k];
    if (di == 0)
      found = {Reflection::Kind::columns, 2 * on[0][0], 1};
    else if (dj == 0)
      found = {Reflection::Kind::rows, 2 * on[0][1], 1};
    else if (std::abs(di) == std::abs(dj))
      found = {Reflection::Kind::diagonal, on[0][0] - (di == dj ? 1 : -1) * on[0][1], di == dj ? 1 : -1};
  }
}

std::array<int, 2> RoundedEdges::image(std::array<int, 2> crossing, unsigned planes) const {
  for (std::size_t k = 0; k < reflection_.size(); ++k) {
    if ((planes >> k & 1U) == 0) continue;
    const auto& [kind, sum, sign] = reflection_[k];
    if (kind == Reflection::Kind::columns)
      crossing[0] = sum - crossing[0];
    else if (kind == Reflection::Kind::rows)
      crossing[1] = sum - crossing[1];
    else
      crossing = {sum + sign * crossing[1], sign * (crossing[0] - sum)};
  }
  return crossing;
}

bool RoundedEdges::can_mirror(unsigned planes) const {
  for (std::size_t k = 0; k < reflection_.size(); ++k)
    if ((planes >> k & 1U) != 0 && reflection_[k].kind == Reflection::Kind::none) return false;
  return true;
}

RoundedEdges::Crossing RoundedEdges::crossing(int i, int j) const {
  for (unsigned planes = 0; planes < 1U << plane_.size(); ++planes) {
    if (!can_mirror(planes)) continue;
    const auto [column, row] = image({i, j}, planes);
    if (column < 0 || row < 0 || column >= stride_ || row >= rows_) continue;
    if (const int node = row * stride_ + column; exists_[node] != 0) return {node, planes};
  }
  return {};
}

bool RoundedEdges::is_quad(int i, int j) const {
  return i >= 0 && j >= 0 && i < stride_ && j < rows_ && surface_.exists(j * stride_ + i);
}

bool RoundedEdges::quad_or_image(int i, int j) const {
  for (unsigned planes = 0; planes < 1U << plane_.size(); ++planes) {
    if (!can_mirror(planes)) continue;
    const auto a = image({i, j}, planes), b = image({i + 1, j + 1}, planes);
    if (is_quad(std::min(a[0], b[0]), std::min(a[1], b[1]))) return true;
  }
  return false;
}

// What there is not of a ring has no weight where the surface is rounded, and stands for the crossing itself.
void RoundedEdges::find_rings() {
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < stride_; ++i) {
      const int node = j * stride_ + i;
      if (exists_[node] == 0) continue;
      quads_[node] = static_cast<std::uint8_t>(
          (quad_or_image(i - 1, j - 1) ? south_west : 0) | (quad_or_image(i, j - 1) ? south_east : 0) |
          (quad_or_image(i - 1, j) ? north_west : 0) | (quad_or_image(i, j) ? north_east : 0));
      Ring ring{};
      bool regular = true;
      for (int b = -1; b <= 1; ++b)
        for (int a = -1; a <= 1; ++a) {
          Crossing& at = ring[static_cast<std::size_t>(3 * (b + 1) + a + 1)];
          at = crossing(i + a, j + b);
          if (at.node < 0) at = {node, 0};
          regular = regular && at.planes == 0 && at.node == node + b * stride_ + a;
        }
      if (regular) continue;
      irregular_[node] = static_cast<int>(irregular_ring_.size());
      irregular_ring_.push_back(ring);
    }
}

Vec3 RoundedEdges::mirrored(const Vec3& vector, unsigned planes) const {
  const auto& rows = mirror_[planes];
  return {dot(rows[0], vector), dot(rows[1], vector), dot(rows[2], vector)};
}

Vec3 RoundedEdges::position_of(const Crossing& crossing, const Components& position) const {
  const Vec3 at = {position[0][crossing.node], position[1][crossing.node], position[2][crossing.node]};
  return crossing.planes == 0 ? at : plus(mirrored_origin_[crossing.planes], mirrored(at, crossing.planes));
}

// West, east, south and north of a crossing, and itself.
std::array<Vec3, 5> RoundedEdges::around(int node, const Components& position) const {
  constexpr std::array<std::size_t, 5> in_ring = {3, 5, 1, 7, 4};
  std::array<Vec3, 5> places{};
  if (irregular_[node] < 0) {
    const std::array<int, 5> at = {node - 1, node + 1, node - stride_, node + stride_, node};
    for (std::size_t k = 0; k < places.size(); ++k) places[k] = position_of({at[k], 0}, position);
  } else {
    const Ring& ring = irregular_ring_[irregular_[node]];
    for (std::size_t k = 0; k < places.size(); ++k) places[k] = position_of(ring[in_ring[k]], position);
  }
  return places;
}

// The angle of an edge times a cell's length is the second difference of the crossings across it, out of the plane.
void RoundedEdges::look(const Components& position) {
  any_ = false;
  for (int node = 0; node < static_cast<int>(quads_.size()); ++node) {
    bent_here_[node] = 0;
    const unsigned quads = quads_[node];
    if (quads == 0) continue;
    const auto has = [quads](unsigned both) { return (quads & both) == both; };
    const auto at = around(node, position);
    const Vec3 normal = cross(minus(at[1], at[0]), minus(at[3], at[2]));
    const auto rises = [&](const Vec3& before, const Vec3& after) {
      const double out = dot(minus(plus(before, after), scaled(at[4], 2.0)), normal);
      return out * out > least_square_ * dot(normal, normal);
    };
    if ((has(south_west | south_east) || has(north_west | north_east)) && rises(at[0], at[1])) bent_here_[node] |= 1;
    if ((has(south_west | north_west) || has(south_east | north_east)) && rises(at[2], at[3])) bent_here_[node] |= 2;
    any_ = any_ || bent_here_[node] != 0;
  }
  spread_along_lines();
}

// A foot asks only the crossing next to it.
void RoundedEdges::spread_along_lines() {
  bent_ = bent_here_;
  if (!any_) return;
  const int count = static_cast<int>(bent_.size());
  for (int node = 0; node < count; ++node) {
    if (quads_[node] == 0) continue;
    for (const auto& [way, bit] : {std::pair{stride_, 1}, {-stride_, 1}, {1, 2}, {-1, 2}})
      if (node + way >= 0 && node + way < count) bent_[node] |= bent_here_[node + way] & bit;
  }
}

EdgePlace RoundedEdges::find_near(const SurfacePlace& place) const {
  if (surface_.is_triangle(place.facet)) return no_edge;
  const bool east = place.xi > 0.5, north = place.eta > 0.5;
  const Vec2 from = {east ? place.xi - 1.0 : place.xi, north ? place.eta - 1.0 : place.eta};
  const bool by_column = std::abs(from[0]) < rounded_within, by_row = std::abs(from[1]) < rounded_within;
  const int node = place.facet + (east ? 1 : 0) + (north ? stride_ : 0);
  unsigned about = static_cast<unsigned>(bent_[node]) & ((by_column ? 1U : 0U) | (by_row ? 2U : 0U));
  if (about == 0) return no_edge;
  const unsigned quads = quads_[node];
  const auto has = [quads](unsigned both) { return (quads & both) == both; };
  if (by_column && by_row && quads != all_four) {
    // of two side by side what lies between them
    if (quads == (north_west | north_east) || quads == (south_west | south_east))
      about &= 1U;
    else if (quads == (south_west | north_west) || quads == (south_east | north_east))
      about &= 2U;
    else
      return no_edge;
  } else if (by_column && !by_row) {
    if (!has(north ? south_west | south_east : north_west | north_east)) return no_edge;
  } else if (by_row && !by_column) {
    if (!has(east ? south_west | north_west : south_east | north_east)) return no_edge;
  }
  if (about == 0) return no_edge;
  const auto chord = [](bool before) { return before ? on_chord_before : on_chord_after; };
  return {node,
          from,
          {(about & 1U) != 0 ? rounded_within : chord(east), (about & 2U) != 0 ? rounded_within : chord(north)}};
}

void RoundedEdges::put(const EdgePlace& edge, SurfacePlace& place) const {
  const int columns = edge.crossing % stride_ - place.facet % stride_,
            rows = edge.crossing / stride_ - place.facet / stride_;
  place.xi = edge.from[0] + columns;
  place.eta = edge.from[1] + rows;
}

SurfaceFrame RoundedEdges::frame(const SurfacePlace& place, const Components& position) const {
  const EdgePlace edge = find(place);
  if (edge.crossing < 0) return surface_.frame(place, position);
  EdgeFeet feet;
  fill(edge, position, 0, feet);
  for (auto& x : feet.x) x[0] = 0.0;
  fill_up(1, feet);
  loops_of_edges().find(edge_feet_padded_to, 0, feet);
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
  if (irregular_[edge.crossing] < 0) {
    for (std::size_t c = 0; c < 3; ++c)
      for (int b = 0; b < 3; ++b) {
        const double* const row = position[c].data() + edge.crossing + static_cast<std::ptrdiff_t>(b - 1) * stride_;
        for (int a = 0; a < 3; ++a) feet.crossing[c][3 * b + a][lane] = row[a - 1];
      }
    return;
  }
  const Ring& ring = irregular_ring_[irregular_[edge.crossing]];
  for (std::size_t k = 0; k < 9; ++k) {
    const Vec3 x = position_of(ring[k], position);
    for (std::size_t c = 0; c < 3; ++c) feet.crossing[c][k][lane] = x[c];
  }
}

int RoundedEdges::fill_up(int count, EdgeFeet& feet) {
  const int end = (count + edge_feet_padded_to - 1) / edge_feet_padded_to * edge_feet_padded_to;
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
  const Ring* const ring = irregular_[edge.crossing] < 0 ? nullptr : &irregular_ring_[irregular_[edge.crossing]];
  for (int b = 0; b < 3; ++b)
    for (int a = 0; a < 3; ++a) {
      const double weight = feet.weight[0][a][lane] * feet.weight[1][b][lane];
      if (weight == 0.0) continue;
      const Crossing at = ring == nullptr ? Crossing{edge.crossing + (b - 1) * stride_ + a - 1, 0}
                                          : (*ring)[static_cast<std::size_t>(3 * b + a)];
      const Vec3 taken = at.planes == 0 ? force : mirrored(force, at.planes);
      for (int c = 0; c < 3; ++c) into[4 * static_cast<std::size_t>(at.node) + c] -= weight * taken[c];
      touched[at.node / ply_segment] = 1;
    }
}

void RoundedEdges::archive(Archive& archive) {
  archive.indices("whether cells meet at an angle", bent_, 0, 3);
  any_ = std::any_of(bent_.begin(), bent_.end(), [](int bent) { return bent != 0; });
}

}  // namespace weaveform
