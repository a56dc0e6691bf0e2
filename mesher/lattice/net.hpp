// The yarn net: straight lines of both families, cut into chords by the outline, and their crossings.
// Everything in yarn coordinates (u along the warp, v along the weft; mm). A line of family f runs along axis f, and
// the lines of one family are numbered along the other axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/lattice/grips.hpp"
#include "mesher/lattice/outline.hpp"

namespace weaveform::lattice {

// Shorter stubs between the last crossing and the outline get no element of their own, as a fraction of the spacing.
// Free: at 0.1 the thinnest cut cell is still soft beside the yarns; its loss moves the boundary by less than a yarn's
// width. Held: the jaws then hold the crossing itself, which would otherwise set the stable step of the whole blank.
constexpr double shortest_free_stub = 0.1;
constexpr double shortest_held_stub = 0.25;
// A chord with less yarn than this in the mesh gives its strip to a neighbour, as a fraction of the spacing.
constexpr double shortest_chord = 0.5;

struct Grid {
  Vec2 spacing = {0.0, 0.0};         // mm; between neighbouring crossings along u and v
  Vec2 origin = {0.0, 0.0};          // mm; crossing (0, 0)
  std::array<int, 2> size = {0, 0};  // crossings along u and v
  double tolerance = 0.0;            // mm; below it two places are the same
  [[nodiscard]] double at(int axis, int index) const { return origin[axis] + index * spacing[axis]; }
};

enum Side : int { low = 0, high = 1 };

enum class Crossing : std::uint8_t { outside, in_mesh, taken_out };

// One uninterrupted stretch of a yarn line inside the outline, and what of it is in the mesh.
struct Chord {
  std::array<double, 2> limit = {0.0, 0.0};  // mm; where the line meets the outline
  std::array<int, 2> reach = {0, -1};        // lowest and highest crossing inside the limits (highest < lowest: none)
  std::array<int, 2> crossing = {0, -1};     // lowest and highest of them that is in the mesh
  std::array<int, 2> grip = {-1, -1};        // grip that holds the end on the outline
  std::array<bool, 2> barred = {};           // an end that no cell would carry: the yarn stops at its crossing
  std::array<bool, 2> ended = {};            // a node on the outline ends the yarn here
  std::array<int, 2> end_node = {-1, -1};
  double length = 0.0;  // mm; of its yarn elements; 0 when it has none
  double yarns = 0.0;   // yarns it stands for
  [[nodiscard]] bool meshed() const { return length > 0.0; }
};

struct YarnNet {
  Grid grid;
  std::array<std::vector<std::vector<Chord>>, 2> line;  // [family][line] -> chords, rising
  std::vector<Crossing> crossing;                       // [j * size[0] + i]
  std::vector<int> node;                                // the same layout: node, or -1
  std::vector<int> held;                                // the same layout: grip that holds the crossing, or -1
  std::vector<Vec2> place;                              // per node: crossings row by row, then yarn ends
  std::vector<int> grip_of_node;                        // per node; -1: free

  // Crossing number k of a line, in the layout above.
  [[nodiscard]] std::size_t index(int family, int which_line, int k) const {
    const int i = family == 0 ? k : which_line;
    const int j = family == 0 ? which_line : k;
    return static_cast<std::size_t>(j) * grid.size[0] + i;
  }
  [[nodiscard]] int node_at(int i, int j) const {
    if (i < 0 || j < 0 || i >= grid.size[0] || j >= grid.size[1]) return -1;
    return node[index(0, j, i)];
  }
  // The yarn end beside crossing k of a line, on the given side and no further away than the next crossing; -1: none.
  [[nodiscard]] int end_beside(int family, int which_line, int k, Side side) const;
};

// Lines a spacing apart, shifted by `phase` spacings from the origin (phase[f] moves the lines of family f), cut by the
// outline; a crossing is in the mesh when it lies on a chord of both its lines.
[[nodiscard]] YarnNet lay_lines(const Outline& outline, const Vec2& spacing, const Vec2& phase);

// Decides every chord's ends and numbers the nodes. To be called again whenever crossings are taken out.
void place_ends(YarnNet& net, const GripRegions& grips);

}  // namespace weaveform::lattice
