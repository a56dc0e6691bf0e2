#include "mesher/lattice/grips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace weaveform::lattice {

namespace {

bool in_box(const GripRegions& grips, const GripRegion& region, const Vec2& point) {
  if (!region.box) return false;
  const Vec2 p = grips.yarns.forward(point);
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (p[axis] < region.box->low[axis] - grips.tolerance || p[axis] > region.box->high[axis] + grips.tolerance)
      return false;
  return true;
}

bool on_edge(const GripRegions& grips, const GripRegion& region, const Vec2& point) {
  for (const auto& edge : region.edge)
    if (distance_to_edge(edge, point) <= grips.tolerance) return true;
  return false;
}

std::string edge_names(const Outline& outline) {
  std::string names;
  for (const auto& edge : outline.edge)
    if (edge.name) names += (names.empty() ? "" : ", ") + name_of(*edge.name);
  return names;
}

// The part of an outline edge inside a box of the blank's frame, as parameters along the edge; rising, or none.
std::optional<Span> part_in_box(const OutlineEdge& edge, const Box& box, const GripRegions& grips) {
  const Vec2 from = grips.yarns.forward(edge.from);
  const Vec2 to = grips.yarns.forward(edge.to);
  Span part{0.0, 1.0};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double step = to[axis] - from[axis];
    if (std::abs(step) <= grips.tolerance) {
      if (from[axis] < box.low[axis] - grips.tolerance || from[axis] > box.high[axis] + grips.tolerance)
        return std::nullopt;
      continue;
    }
    const double a = (box.low[axis] - from[axis]) / step;
    const double b = (box.high[axis] - from[axis]) / step;
    part = {std::max(part.from, std::min(a, b)), std::min(part.to, std::max(a, b))};
  }
  if (part.from >= part.to) return std::nullopt;
  return part;
}

// The pieces of the outline a grip holds; those shorter than the tolerance are corners of a neighbouring piece.
std::vector<OutlineEdge> held_pieces(const GripRegion& region, const Outline& outline, const GripRegions& grips) {
  if (!region.box) return region.edge;
  std::vector<OutlineEdge> pieces;
  for (const auto& edge : outline.edge) {
    const auto part = part_in_box(edge, *region.box, grips);
    if (!part) continue;
    const Vec2 along = {edge.to[0] - edge.from[0], edge.to[1] - edge.from[1]};
    if ((part->to - part->from) * std::hypot(along[0], along[1]) <= 4.0 * grips.tolerance) continue;
    const auto at = [&](double t) { return Vec2{edge.from[0] + t * along[0], edge.from[1] + t * along[1]}; };
    pieces.push_back({at(part->from), at(part->to), edge.name});
  }
  return pieces;
}

// Ends of the pieces that no other piece goes on from.
std::vector<Vec2> held_ends(const std::vector<OutlineEdge>& pieces, double tolerance) {
  std::vector<Vec2> ends;
  for (const auto& piece : pieces) {
    const auto goes_on = [&](const Vec2& end) {
      return std::any_of(pieces.begin(), pieces.end(), [&](const OutlineEdge& other) {
        return &other != &piece && distance_to_edge(other, end) <= tolerance;
      });
    };
    for (const auto& end : {piece.from, piece.to})
      if (!goes_on(end)) ends.push_back(end);
  }
  return ends;
}

}  // namespace

int GripRegions::holding(const Vec2& point) const {
  for (std::size_t g = 0; g < region.size(); ++g)
    if (in_box(*this, region[g], point) || on_edge(*this, region[g], point)) return static_cast<int>(g);
  return -1;
}

int GripRegions::box_holding(const Vec2& point) const {
  for (std::size_t g = 0; g < region.size(); ++g)
    if (in_box(*this, region[g], point)) return static_cast<int>(g);
  return -1;
}

int GripRegions::holding_beside(const Vec2& yarn_end, int family, const Vec2& spacing, int not_by) const {
  const int across = 1 - family;
  for (std::size_t g = 0; g < region.size(); ++g) {
    if (region[g].box || static_cast<int>(g) == not_by) continue;
    for (const auto& end : region[g].end) {
      const bool half_held = std::abs(yarn_end[across] - end[across]) < 0.5 * spacing[across] - tolerance;
      // A line nearly along the neighbouring edge ends far from the grip, where the fabric is free to move.
      const bool close_by = std::abs(yarn_end[family] - end[family]) <= spacing[family] + tolerance;
      if (half_held && close_by) return static_cast<int>(g);
    }
  }
  return -1;
}

GripRegions grip_regions(const Scene& scene, const Outline& outline, const Turn& yarns, double tolerance,
                         std::vector<std::string>& complaints) {
  GripRegions grips{{}, yarns, tolerance};
  for (const auto& grip : scene.grip) {
    GripRegion region{grip.name, {}, {}, {}, grip.free.empty()};
    if (grip.box) {
      const auto& b = *grip.box;
      region.box = Box{{b[0], b[1]}, {b[2], b[3]}};
    } else {
      for (const auto& edge : outline.edge)
        if (edge.name && edge.name == grip.edge) region.edge.push_back(edge);
      if (region.edge.empty())
        complaints.push_back(
            edge_names(outline).empty()
                ? fmt::format("grip '{}': a {} has no edges with names; give the grip a 'box' instead", grip.name,
                              scene.blank.shape == BlankShape::file ? "blank from a file" : name_of(scene.blank.shape))
                : fmt::format("grip '{}': the blank has no edge '{}'; its edges are: {}", grip.name,
                              grip.edge ? name_of(*grip.edge) : "", edge_names(outline)));
    }
    region.end = held_ends(held_pieces(region, outline, grips), tolerance);
    grips.region.push_back(region);
  }
  return grips;
}

}  // namespace weaveform::lattice
