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
};

// Complaints (an edge the outline has not got) go to `complaints`.
[[nodiscard]] GripRegions grip_regions(const Scene& scene, const Outline& outline, const Turn& yarns, double tolerance,
                                       std::vector<std::string>& complaints);

}  // namespace weaveform::lattice
