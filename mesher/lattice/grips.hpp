// Which part of the blank a grip holds: an edge of the outline or a box in the blank's frame.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesher/lattice/outline.hpp"
#include "mesher/scene/scene.hpp"

namespace weaveform::lattice {

struct GripRegion {
  std::string name;
  std::vector<OutlineEdge> edge;  // yarn coordinates; empty for a box
  std::optional<Box> box;         // blank's frame
  std::vector<Vec2> end;          // yarn coordinates; where the part of the outline it holds begins and stops
  bool rigid = true;              // holds every component; false when the grip leaves some free
};

struct GripRegions {
  std::vector<GripRegion> region;
  Turn yarns;              // from yarn coordinates to the blank's frame
  double tolerance = 0.0;  // mm

  // The first grip that holds the given point of the flat blank (yarn coordinates); -1: none. First wins where two
  // meet.
  [[nodiscard]] int holding(const Vec2& point) const;
  // The same, boxes only: a point well inside the blank is not on an edge.
  [[nodiscard]] int box_holding(const Vec2& point) const;
  // The first grip on an edge that takes hold of a yarn end beside that edge; -1: none. The line of the yarn (of the
  // given family) then passes within half a spacing of the edge's end, so that the strip it stands for is half held:
  // the last line held lies up to half a spacing inside the end or beyond it, and the border of the deforming zone is
  // unbiased; held edges alone would leave it half a spacing inside on average. Boxes hold what lies in them, no more.
  // `not_by`: a grip that holds the yarn's other end; across a corner the strip is not half held but held once.
  [[nodiscard]] int holding_beside(const Vec2& yarn_end, int family, const Vec2& spacing, int not_by) const;
};

// Complaints (an edge the outline has not got) go to `complaints`.
[[nodiscard]] GripRegions grip_regions(const Scene& scene, const Outline& outline, const Turn& yarns, double tolerance,
                                       std::vector<std::string>& complaints);

}  // namespace weaveform::lattice
