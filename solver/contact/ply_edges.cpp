// Feet of a block where the other ply's surface is rounded, and what its crossings take there.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/ply_pass.hpp"

namespace weaveform {

// Only what may touch: what rounding brings nearer is less than its border's width.
void PlyPassState::find_rounded(int number, const PlyPassNodes& nodes, const PlyFeet& feet,
                                RoundedFeet& rounded) const {
  const RoundedEdges& edges = other_.edges();
  const PlyBlock& block = own_.blocks()[number];
  const auto& position = other_.state().position;
  const double far = swollen_ ? std::numeric_limits<double>::infinity()
                              : std::pow(law_.reach - law_.adhesion + edges.greatest_change(), 2);
  for (int i = 0; i < block.count; ++i) {
    const int l = block.at + i;
    if (on_quads_[l] == 0.0 || feet.square[i] > far) continue;
    const EdgePlace edge = edges.find(place_of(l));
    if (edge.crossing < 0) continue;
    const int k = rounded.count++;
    rounded.node[k] = i;
    rounded.edge[k] = edge;
    edges.fill(edge, position, k, rounded.at);
    for (std::size_t c = 0; c < 3; ++c) {
      rounded.at.x[c][k] = nodes.x[c][i];
      rounded.at.n[c][k] = nodes.normals->n[c][i];
    }
  }
}

// The kernel's foot on the cell is where the one on the rounded surface is looked for: some 1e-4 of a cell away where
// cells meet at 40 degrees. Newton's steps leave 1e-6 and 1e-11.
void PlyPassState::round_edges(int number, const PlyPassNodes& nodes, PlyFeet& feet, RoundedFeet& rounded) {
  constexpr int steps = 2;
  find_rounded(number, nodes, feet, rounded);
  if (rounded.count == 0) return;
  const EdgeFeet& at = rounded.at;
  loops_of_edges().find(RoundedEdges::fill_up(rounded.count, rounded.at), steps, rounded.at);
  for (int k = 0; k < rounded.count; ++k) {
    const int i = rounded.node[k], l = own_.blocks()[number].at + i;
    const SurfacePlace on_cell = place_of(l);
    SurfacePlace place = on_cell;
    other_.edges().put({rounded.edge[k].crossing, {at.place[0][k], at.place[1][k]}, {}}, place);
    put(l, place);
    feet.dxi[i] += place.xi - on_cell.xi;
    feet.deta[i] += place.eta - on_cell.eta;
    const Vec3 s1 = {at.s1[0][k], at.s1[1][k], at.s1[2][k]}, s2 = {at.s2[0][k], at.s2[1][k], at.s2[2][k]},
               r = {at.r[0][k], at.r[1][k], at.r[2][k]}, n = {at.n[0][k], at.n[1][k], at.n[2][k]};
    const Vec3 m = cross(s1, s2);
    const double m_n = dot(m, n);
    for (std::size_t c = 0; c < 3; ++c) {
      feet.s1[c][i] = s1[c];
      feet.s2[c][i] = s2[c];
      feet.r[c][i] = r[c];
    }
    feet.square[i] = dot(r, r);
    feet.along[i] = dot(r, n);
    feet.meets[i] = m_n > 0.0 ? std::clamp(4.0 * m_n * m_n / (dot(m, m) * dot(n, n)) - 1.0, 0.0, 1.0) : 0.0;
  }
}

// What acts on the other's thickness stays with the corners that it is interpolated between.
void PlyPassState::give_back_rounded(const RoundedFeet& rounded, const PlyPassNodes& nodes, PlyPassForces& forces,
                                     PlyReturn& back) const {
  for (int k = 0; k < rounded.count; ++k) {
    const int i = rounded.node[k];
    if (!(forces.acts[i] > 0.0)) continue;
    forces.acts[i] = 0.0;
    const double* const force = forces.force + 4 * static_cast<std::size_t>(i);
    other_.edges().give_back(rounded.edge[k], rounded.at, k, {force[0], force[1], force[2]}, back.force.data(),
                             back.touched.data());
    if (!swollen_) continue;
    for (int a = 0; a < 4; ++a) {
      const long node = nodes.corner[i] + (a == 0 ? 0 : nodes.beside[a - 1]);
      back.force[4 * node + 3] -= forces.weight[a][i] * force[3];
      back.touched[node / ply_segment] = 1;
    }
  }
}

}  // namespace weaveform
