#include "mesher/lattice/strips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace weaveform::lattice {

namespace {

// One family's sharing: areas (mm^2) gathered per chord.
struct Sharing {
  YarnNet& net;
  const Outline& outline;
  int family;
  double least_area;  // mm^2; below it is rounding
  double interval;    // mm

  void give(Chord& chord, double area) const { chord.yarns += area / (interval * chord.length); }
};

double gap_to(const Chord& chord, double along) {
  return std::max({0.0, chord.limit[low] - along, along - chord.limit[high]});
}

// The chord with elements nearest to a place on a line: distances in spacings, along and across added; of two alike the
// longer, which feels it less. Null when the family has none.
Chord* nearest_chord(const Sharing& sharing, int which_line, double along) {
  auto& line = sharing.net.line[sharing.family];
  const double h = sharing.net.grid.spacing[sharing.family];
  const int count = static_cast<int>(line.size());
  Chord* best = nullptr;
  double best_distance = std::numeric_limits<double>::infinity();
  for (int away = 0; away < count && away <= best_distance; ++away) {
    for (const int c : {which_line - away, which_line + away}) {
      if (c < 0 || c >= count) continue;
      for (auto& chord : line[c]) {
        if (!chord.meshed()) continue;
        const double distance = away + gap_to(chord, along) / h;
        const bool longer = best != nullptr && distance == best_distance && chord.length > best->length;
        if (distance < best_distance || longer) {
          best = &chord;
          best_distance = distance;
        }
      }
    }
  }
  return best;
}

// Gives away a part of a strip that its own line cannot take, halved until the pieces are no longer than a spacing.
void give_away(const Sharing& sharing, int which_line, const Box& box) {
  const int f = sharing.family;
  if (box.high[f] <= box.low[f]) return;
  const double area = moments_in_box(sharing.outline, box).area;
  if (std::abs(area) <= sharing.least_area) return;
  const double middle = 0.5 * (box.low[f] + box.high[f]);
  if (box.high[f] - box.low[f] > sharing.net.grid.spacing[f]) {
    Box half = box;
    half.high[f] = middle;
    give_away(sharing, which_line, half);
    half = box;
    half.low[f] = middle;
    give_away(sharing, which_line, half);
  } else if (Chord* chord = nearest_chord(sharing, which_line, middle)) {
    sharing.give(*chord, area);
  }
}

// Half a spacing to either side; the outermost lines take all there is beyond them.
Box strip_box(const YarnNet& net, const Box& bounds, int family, int which_line) {
  const int across = 1 - family;
  const double centre = net.grid.at(across, which_line);
  const double half = 0.5 * net.grid.spacing[across];
  Box box = bounds;
  if (which_line > 0) box.low[across] = centre - half;
  if (which_line + 1 < static_cast<int>(net.line[family].size())) box.high[across] = centre + half;
  return box;
}

// Along the line: what lies between and beyond the chords is given away, what lies at a chord is its own.
void share_strip(const Sharing& sharing, const Box& bounds, int which_line) {
  const int f = sharing.family;
  const double margin = 0.5 * sharing.net.grid.spacing[f];
  const Box strip = strip_box(sharing.net, bounds, f, which_line);
  auto& on_line = sharing.net.line[f][which_line];
  double done = strip.low[f];
  for (std::size_t k = 0; k < on_line.size(); ++k) {
    Chord& chord = on_line[k];
    if (!chord.meshed()) continue;
    double last = std::min(strip.high[f], chord.limit[high] + margin);
    if (k + 1 < on_line.size()) last = std::min(last, 0.5 * (chord.limit[high] + on_line[k + 1].limit[low]));
    const double first = std::clamp(chord.limit[low] - margin, done, last);
    Box part = strip;
    part.low[f] = done;
    part.high[f] = first;
    give_away(sharing, which_line, part);
    part.low[f] = first;
    part.high[f] = last;
    sharing.give(chord, moments_in_box(sharing.outline, part).area);
    done = last;
  }
  Box rest = strip;
  rest.low[f] = done;
  give_away(sharing, which_line, rest);
}

}  // namespace

void share_strips(YarnNet& net, const Outline& outline, const Vec2& interval) {
  const Box bounds = bounding_box(outline);
  for (int family = 0; family < 2; ++family) {
    for (auto& on_line : net.line[family])
      for (auto& chord : on_line) chord.yarns = 0.0;
    // 1e-16 of a cell: what is dropped stays below the rounding of the sum.
    const Sharing sharing{net, outline, family, 1e-16 * net.grid.spacing[0] * net.grid.spacing[1], interval[family]};
    for (int c = 0; c < static_cast<int>(net.line[family].size()); ++c) share_strip(sharing, bounds, c);
  }
}

}  // namespace weaveform::lattice
