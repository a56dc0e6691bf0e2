// The surface of a ply as nodes of others press on it: that of PlySurface, rounded where its quads meet.
//
// A node that lies on an edge, or in the dent that four chords make, goes from cell to cell every few steps. Its force
// turns at once by the angle between the two, and a step over the edge has the work of neither: eight plies over coarse
// cells gained a sixth of their energy so. Within b of a line of crossings the surface is therefore the mean of the
// cells' own over 2 b across the line (edge_kernel.hpp), which has no edge. Its N_a sum to 1, and to the material's own
// coordinates, so that forces are those of a potential as on the cells (ply_kernel.hpp).
//
// Width. b cells of length h are w = b h, a twentieth of the ply's thickness. A ridge is lower for it by w/4 times its
// angle theta and a valley higher, 1 % of the thickness at 45 degrees; and a force N that turns by theta over 2 w is a
// spring N theta/(2 w) across the edge, of a node p deep on a spring k no more than k p theta/(2 w): narrower, and nodes
// that are pressed hard would be too stiff for the step.
//
// Not rounded are edges that no second quad lies on (the ply's own, a hole's, those of the triangles that the outline
// leaves), and those whose angle is next to nothing.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/vector/vector.hpp"
#include "solver/contact/crossing_rings.hpp"
#include "solver/contact/edge_kernel.hpp"
#include "solver/contact/ply_surface.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// A place on the surface where it is rounded.
struct EdgePlace {
  int crossing;  // packed; the one next to it; -1: not rounded there
  Vec2 from;     // cells; from it
  Vec2 border;   // b along warp and weft, or which chord
};
inline constexpr EdgePlace no_edge = {-1, {0.0, 0.0}, {0.0, 0.0}};

class RoundedEdges {
public:
  // Both must outlive this.
  RoundedEdges(const Ply& ply, const PlySurface& surface);

  // Finds the edges that have an angle now.
  void look(const Components& position);
  [[nodiscard]] bool any() const { return any_; }

  // mm; by no more does rounding move the surface.
  [[nodiscard]] double greatest_change() const { return greatest_change_; }

  [[nodiscard]] EdgePlace find(const SurfacePlace& place) const {
    const bool inside = std::abs(std::abs(place.xi - 0.5) - 0.5) >= border_[0] &&
                        std::abs(std::abs(place.eta - 0.5) - 0.5) >= border_[1];
    return inside || !any_ ? no_edge : find_near(place);
  }
  // The same place on a facet beside the crossing.
  void put(const EdgePlace& edge, SurfacePlace& place) const;
  // The surface's point and slopes, rounded or not.
  [[nodiscard]] SurfaceFrame frame(const SurfacePlace& place, const Components& position) const;

  // A lane's crossings, place and borders.
  void fill(const EdgePlace& edge, const Components& position, int lane, EdgeFeet& feet) const;
  // Copies of the first lane up to a whole vector; how many there are then.
  static int fill_up(int count, EdgeFeet& feet);
  // Takes weight * force (N) from each crossing, of images from what they mirror: into[4 * node + c].
  void give_back(const EdgePlace& edge, const EdgeFeet& feet, int lane, const Vec3& force, double* into,
                 char* touched) const;

  void archive(Archive& archive);

private:
  [[nodiscard]] EdgePlace find_near(const SurfacePlace& place) const;
  [[nodiscard]] int bent_at(int node, const Components& position) const;

  const PlySurface& surface_;
  CrossingRings rings_;
  Vec2 border_;             // cells; b along warp and weft
  double least_square_;     // mm^2
  double greatest_change_;  // mm
  // Per lattice node: the coordinates across whose line, here or a crossing further along it, cells meet at an angle;
  // bit 0 warp's, bit 1 weft's.
  std::vector<int> bent_;
  bool any_ = false;
};

}  // namespace weaveform
