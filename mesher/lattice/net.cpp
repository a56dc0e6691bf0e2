#include "mesher/lattice/net.hpp"

#include <algorithm>
#include <cmath>

namespace weaveform::lattice {

namespace {

Grid lay_grid(const Outline& outline, const Vec2& spacing, const Vec2& phase) {
  Grid grid;
  grid.spacing = spacing;
  grid.tolerance = 1e-7 * std::min(spacing[0], spacing[1]);
  const Box box = bounding_box(outline);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // Positions along the warp (axis 0) are those of the weft lines, which phase[1] moves.
    const double shift = phase[1 - axis];
    const double first = std::ceil((box.low[axis] - grid.tolerance) / spacing[axis] - shift);
    const double last = std::floor((box.high[axis] + grid.tolerance) / spacing[axis] - shift);
    grid.origin[axis] = (first + shift) * spacing[axis];
    grid.size[axis] = std::max(0, static_cast<int>(last - first) + 1);
  }
  return grid;
}

Chord make_chord(const Grid& grid, int family, const Span& inside) {
  Chord chord;
  chord.limit = {inside.from, inside.to};
  const double h = grid.spacing[family];
  const double first = std::ceil((inside.from - grid.tolerance - grid.origin[family]) / h);
  const double last = std::floor((inside.to + grid.tolerance - grid.origin[family]) / h);
  chord.reach = {std::max(0, static_cast<int>(first)), std::min(grid.size[family] - 1, static_cast<int>(last))};
  return chord;
}

// Draws in the chord's ends to the crossings still in the mesh.
void find_crossings(const YarnNet& net, int family, int which_line, Chord& chord) {
  const auto in_mesh = [&](int k) { return net.crossing[net.index(family, which_line, k)] == Crossing::in_mesh; };
  auto [first, last] = chord.reach;
  while (first <= last && !in_mesh(first)) ++first;
  while (last >= first && !in_mesh(last)) --last;
  chord.crossing = {first, last};
}

Vec2 point_on(const YarnNet& net, int family, int which_line, double along) {
  Vec2 p;
  p[family] = along;
  p[1 - family] = net.grid.at(1 - family, which_line);
  return p;
}

// One end of a chord: on the outline, or at its last crossing when the stub between them is too short (the grip then
// holds the crossing) or reaches past a crossing that was taken out.
void decide_end(YarnNet& net, int family, int which_line, Side side, Chord& chord) {
  const double h = net.grid.spacing[family];
  const double stub = std::abs(chord.limit[side] - net.grid.at(family, chord.crossing[side]));
  const std::size_t last_crossing = net.index(family, which_line, chord.crossing[side]);
  if (chord.grip[side] >= 0) {
    chord.ended[side] = stub >= shortest_held_stub * h;
    if (!chord.ended[side] && net.held[last_crossing] < 0) net.held[last_crossing] = chord.grip[side];
  } else {
    chord.ended[side] = !chord.barred[side] && stub >= shortest_free_stub * h && stub <= h + 2.0 * net.grid.tolerance;
  }
}

// The grips that hold a chord's two ends on the outline.
void find_grips(const YarnNet& net, const GripRegions& grips, int family, int which_line, Chord& chord) {
  std::array<Vec2, 2> end;
  for (const Side side : {low, high}) {
    end[side] = point_on(net, family, which_line, chord.limit[side]);
    chord.grip[side] = grips.holding(end[side]);
  }
  const std::array<int, 2> on_edge = chord.grip;
  for (const Side side : {low, high})
    if (on_edge[side] < 0)
      chord.grip[side] = grips.holding_beside(end[side], family, net.grid.spacing, on_edge[1 - side]);
}

void measure_chord(const Grid& grid, int family, Chord& chord) {
  const auto end = [&](Side side) {
    return chord.ended[side] ? chord.limit[side] : grid.at(family, chord.crossing[side]);
  };
  chord.length = end(high) - end(low);
  if (chord.length >= shortest_chord * grid.spacing[family]) return;
  chord.length = 0.0;
  chord.ended = {};
}

void number_nodes(YarnNet& net, const GripRegions& grips) {
  net.place.clear();
  net.grip_of_node.clear();
  const auto add = [&](const Vec2& place, int grip) {
    net.place.push_back(place);
    net.grip_of_node.push_back(grip);
    return static_cast<int>(net.place.size()) - 1;
  };
  for (int j = 0; j < net.grid.size[1]; ++j) {
    for (int i = 0; i < net.grid.size[0]; ++i) {
      const std::size_t k = net.index(0, j, i);
      net.node[k] = -1;
      if (net.crossing[k] != Crossing::in_mesh) continue;
      const Vec2 place = {net.grid.at(0, i), net.grid.at(1, j)};
      const int box = grips.box_holding(place);
      net.node[k] = add(place, box >= 0 ? box : net.held[k]);
    }
  }
  for (int family = 0; family < 2; ++family) {
    for (int c = 0; c < static_cast<int>(net.line[family].size()); ++c) {
      for (auto& chord : net.line[family][c]) {
        for (const Side side : {low, high})
          chord.end_node[side] =
              chord.ended[side] ? add(point_on(net, family, c, chord.limit[side]), chord.grip[side]) : -1;
      }
    }
  }
}

}  // namespace

int YarnNet::end_beside(int family, int which_line, int k, Side side) const {
  if (which_line < 0 || which_line >= grid.size[1 - family]) return -1;
  for (const auto& chord : line[family][which_line]) {
    if (!chord.ended[side] || chord.crossing[side] != k) continue;
    const double stub = std::abs(chord.limit[side] - grid.at(family, k));
    return stub <= grid.spacing[family] + 2.0 * grid.tolerance ? chord.end_node[side] : -1;
  }
  return -1;
}

YarnNet lay_lines(const Outline& outline, const Vec2& spacing, const Vec2& phase) {
  YarnNet net;
  net.grid = lay_grid(outline, spacing, phase);
  const std::size_t count = static_cast<std::size_t>(net.grid.size[0]) * net.grid.size[1];
  net.crossing.assign(count, Crossing::outside);
  std::vector<std::uint8_t> mark_of(count, 0);
  net.node.assign(count, -1);
  net.held.assign(count, -1);
  for (int family = 0; family < 2; ++family) {
    net.line[family].resize(net.grid.size[1 - family]);
    for (int c = 0; c < net.grid.size[1 - family]; ++c) {
      for (const auto& inside : chords(outline, family, net.grid.at(1 - family, c), net.grid.tolerance)) {
        // A line that only touches a corner; by rounding it would be in or out.
        if (inside.to - inside.from <= 4.0 * net.grid.tolerance) continue;
        const Chord chord = make_chord(net.grid, family, inside);
        net.line[family][c].push_back(chord);
        for (int k = chord.reach[low]; k <= chord.reach[high]; ++k) {
          auto& mark = mark_of[net.index(family, c, k)];
          mark = static_cast<std::uint8_t>(mark | (1 << family));
        }
      }
    }
  }
  // Marked by both families; by one alone it lies outside by a rounding error.
  for (std::size_t k = 0; k < count; ++k)
    if (mark_of[k] == 3) net.crossing[k] = Crossing::in_mesh;
  return net;
}

void place_ends(YarnNet& net, const GripRegions& grips) {
  std::fill(net.held.begin(), net.held.end(), -1);
  for (int family = 0; family < 2; ++family) {
    for (int c = 0; c < static_cast<int>(net.line[family].size()); ++c) {
      for (auto& chord : net.line[family][c]) {
        find_crossings(net, family, c, chord);
        chord.ended = {};
        chord.length = 0.0;
        if (chord.crossing[high] < chord.crossing[low]) continue;
        find_grips(net, grips, family, c, chord);
        for (const Side side : {low, high}) decide_end(net, family, c, side, chord);
        measure_chord(net.grid, family, chord);
      }
    }
  }
  number_nodes(net, grips);
}

}  // namespace weaveform::lattice
