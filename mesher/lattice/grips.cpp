#include "mesher/lattice/grips.hpp"

#include <fmt/format.h>

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
    if (!edge.name.empty()) names += (names.empty() ? "" : ", ") + edge.name;
  return names;
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

GripRegions grip_regions(const Scene& scene, const Outline& outline, const Turn& yarns, double tolerance,
                         std::vector<std::string>& complaints) {
  GripRegions grips{{}, yarns, tolerance};
  for (const auto& grip : scene.grip) {
    GripRegion region{grip.name, {}, {}, grip.free.empty()};
    if (grip.box) {
      const auto& b = *grip.box;
      region.box = Box{{b[0], b[1]}, {b[2], b[3]}};
    } else {
      for (const auto& edge : outline.edge)
        if (edge.name == grip.edge) region.edge.push_back(edge);
      if (region.edge.empty())
        complaints.push_back(fmt::format("grip '{}': the blank has no edge '{}'; its edges are: {}", grip.name,
                                         grip.edge, edge_names(outline)));
    }
    grips.region.push_back(region);
  }
  return grips;
}

}  // namespace weaveform::lattice
