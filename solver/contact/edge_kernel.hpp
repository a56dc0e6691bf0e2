// Feet of nodes on another ply's surface where that is rounded (rounded_edges.hpp), for several nodes at once.
//
// With (u, v) the foot from the crossing next to it, in cells along warp and weft, and b how far from the line of
// crossings the surface is the mean of the cells' own over u - b .. u + b:
//   N_-1 = (b - u)^2/(4 b),   N_1 = N_-1 + u,   N_0 = 1 - N_-1 - N_1      of the crossings before, at and after it
// which is a parabola between the two chords, with their slopes at its ends, beyond b the chords. Along a coordinate that
// is not rounded it is one chord, on from the crossing or up to it. Across warp and weft the product of both:
// S = sum N_a(u) N_b(v) x_ab.
#pragma once

#include "solver/contact/ply_kernel.hpp"

namespace weaveform {

// In place of b.
inline constexpr double on_chord_after = 0.0, on_chord_before = -1.0;

// Anything finite in the lanes that fill a vector up.
struct EdgeFeet {
  // mm; of the crossing and the eight around it, 3 * row + column, warp lines by column
  alignas(64) double crossing[3][9][ply_nodes_at_a_time];
  alignas(64) double x[3][ply_nodes_at_a_time];       // mm; the node
  alignas(64) double n[3][ply_nodes_at_a_time];       // its normal, of any length
  alignas(64) double border[2][ply_nodes_at_a_time];  // cells; b
  alignas(64) double place[2][ply_nodes_at_a_time];   // cells; (u, v), moved
  // there
  alignas(64) double s1[3][ply_nodes_at_a_time], s2[3][ply_nodes_at_a_time];  // mm; S_u, S_v
  alignas(64) double r[3][ply_nodes_at_a_time];                               // mm; x - S
  alignas(64) double weight[2][3][ply_nodes_at_a_time];                       // N along u and v
};

// `steps` of Newton's towards where the line from x along n meets the surface, and what is there. A foot whose line runs
// along the surface stays.
using FindEdgeFeet = void(int count, int steps, EdgeFeet& feet);

struct EdgeLoops {
  FindEdgeFeet* find;
};

[[nodiscard]] const EdgeLoops& loops_of_edges();

}  // namespace weaveform
