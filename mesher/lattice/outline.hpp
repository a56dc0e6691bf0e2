// The blank's outline in yarn coordinates (u along the warp, v along the weft; mm), and the three questions the lattice
// asks of it: where a yarn line lies inside, how much area a box cuts from it, whether a point lies on one of its
// edges. Any simple polygon will do, convex or not, with holes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/scene/choices.hpp"

namespace weaveform::lattice {

struct OutlineEdge {
  Vec2 from = {0.0, 0.0};              // mm
  Vec2 to = {0.0, 0.0};                // mm
  std::optional<BlankEdge> name = {};  // what a grip calls it; none when no grip can
};

// The blank lies to the left of every edge: outer boundary counter-clockwise, holes clockwise.
struct Outline {
  std::vector<OutlineEdge> edge;
};

struct Box {
  Vec2 low = {0.0, 0.0};   // mm
  Vec2 high = {0.0, 0.0};  // mm
};

struct Span {
  double from = 0.0;  // mm
  double to = 0.0;    // mm
};

struct Moments {
  double area = 0.0;        // mm^2
  Vec2 first = {0.0, 0.0};  // mm^3; area times centroid
};

// A turn in the plane. Exact at multiples of 45 degrees, so that mirrored blanks give mirrored meshes.
struct Turn {
  double cosine = 1.0;
  double sine = 0.0;
  [[nodiscard]] Vec2 forward(const Vec2& p) const { return {cosine * p[0] - sine * p[1], sine * p[0] + cosine * p[1]}; }
  [[nodiscard]] Vec2 back(const Vec2& p) const { return {cosine * p[0] + sine * p[1], -sine * p[0] + cosine * p[1]}; }
};
[[nodiscard]] Turn turn_by_degrees(double degrees);

// size[0] x size[1] (mm) about the origin; edges "bottom", "right", "top", "left" of the blank's frame. `yarns` turns
// yarn coordinates into that frame.
[[nodiscard]] Outline rectangle_outline(const Vec2& size, const Turn& yarns);

[[nodiscard]] Box bounding_box(const Outline& outline);

// The part of the outline inside a box.
[[nodiscard]] Moments moments_in_box(const Outline& outline, const Box& box);

// Where the line {x[1 - axis] = across} lies inside the outline: intervals of x[axis], rising. A line within
// `tolerance` of an edge it runs along counts as inside.
[[nodiscard]] std::vector<Span> chords(const Outline& outline, int axis, double across, double tolerance);

// Distance (mm) from a point to an edge.
[[nodiscard]] double distance_to_edge(const OutlineEdge& edge, const Vec2& point);

}  // namespace weaveform::lattice
