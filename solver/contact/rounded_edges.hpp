// The surface of a ply as nodes of others press on it: that of PlySurface, rounded where its quads meet.
//
// A node that lies on an edge, or in the dent that four chords make, goes from cell to cell every few steps. Its force
// turns at once by the angle between the two, and a step over the edge has the work of neither: eight plies over coarse
// cells gained a sixth of their energy so. Within b of a line of crossings the surface is therefore the mean of the
// cells' own over 2 b across the line (edge_kernel.hpp), which has no edge. Its N_a sum to 1, and to the material's own
// coordinates, so that forces are those of a potential as on the cells (ply_kernel.hpp). A ridge is lower for it by b/4
// of its angle times the length of a cell, a valley higher.
//
// Not rounded are edges that no second quad lies on (the ply's own, a hole's, those of the triangles that the outline
// leaves), and those whose angle is next to nothing.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vector/vector.hpp"
#include "mesher/mesh/mesh.hpp"
#include "solver/contact/edge_kernel.hpp"
#include "solver/contact/ply_surface.hpp"
#include "solver/state/archive.hpp"
#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// A place on the surface where it is rounded.
struct EdgePlace {
  int crossing;  // packed; the one next to it; -1: not rounded there
  Vec2 from;     // cells; from it
  Vec2 border;   // b along warp and weft, or which chord
};
inline constexpr double rounded_within = 0.005;  // cells; b
inline constexpr EdgePlace no_edge = {-1, {0.0, 0.0}, {0.0, 0.0}};

class RoundedEdges {
public:
  // All must outlive this.
  RoundedEdges(const Mesh& mesh, const PackedMesh& packed, const PlySurface& surface);

  // Finds the edges that have an angle now.
  void look(const Components& position);
  [[nodiscard]] bool any() const { return any_; }

  // mm; by no more does rounding move the surface, where cells meet at less than two right angles.
  [[nodiscard]] double greatest_change() const { return greatest_change_; }

  [[nodiscard]] EdgePlace find(const SurfacePlace& place) const {
    const bool inside = std::abs(std::abs(place.xi - 0.5) - 0.5) >= rounded_within &&
                        std::abs(std::abs(place.eta - 0.5) - 0.5) >= rounded_within;
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
  struct Crossing {
    int node = -1;        // packed; -1: there is none
    unsigned planes = 0;  // its image in every mirror plane whose bit is set
  };
  using Ring = std::array<Crossing, 9>;  // of a crossing and those around it; 3 * row + column
  // A mirror plane that goes through crossings: (i, j) to (sum - i, j), (i, sum - j), or, along diagonals, to
  // (sum + sign j, sign (i - sum)).
  struct Reflection {
    enum class Kind { none, columns, rows, diagonal } kind = Kind::none;
    int sum = 0, sign = 1;
  };
  [[nodiscard]] EdgePlace find_near(const SurfacePlace& place) const;
  void find_reflections(const Mesh& mesh);
  void find_rings();
  [[nodiscard]] std::array<int, 2> image(std::array<int, 2> crossing, unsigned planes) const;
  [[nodiscard]] bool can_mirror(unsigned planes) const;
  [[nodiscard]] Crossing crossing(int i, int j) const;
  [[nodiscard]] bool is_quad(int i, int j) const;
  [[nodiscard]] bool quad_or_image(int i, int j) const;
  [[nodiscard]] Vec3 mirrored(const Vec3& vector, unsigned planes) const;
  [[nodiscard]] Vec3 position_of(const Crossing& crossing, const Components& position) const;
  [[nodiscard]] std::array<Vec3, 5> around(int node, const Components& position) const;
  void spread_along_lines();

  const PlySurface& surface_;
  const std::vector<SymmetryPlane>& plane_;
  std::vector<std::array<Vec3, 3>> mirror_;  // rows, for every set of planes
  std::vector<Vec3> mirrored_origin_;        // mm; likewise
  int stride_, rows_;
  double least_square_;     // mm^2
  double greatest_change_;  // mm
  std::vector<char> exists_;
  std::vector<Reflection> reflection_;
  // per lattice node
  std::vector<std::uint8_t> quads_;  // which of the four around it there are
  std::vector<int> irregular_;       // of a crossing whose ring is not made of the nodes around it: its number; -1
  std::vector<Ring> irregular_ring_;
  std::vector<int> bent_, bent_here_;  // coordinates across whose line it is an edge: bit 0 warp's, bit 1 weft's
  bool any_ = false;
};

}  // namespace weaveform
