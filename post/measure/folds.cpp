#include "post/measure/folds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vector/vector.hpp"
#include "post/forming/wrinkles.hpp"
#include "solver/bending/bending_energy.hpp"

namespace weaveform {
namespace {

// Per node: the turn of each family out of the fabric's plane (rad, signed), and the node after it on the yarn. The
// turn is 0 where no yarn runs on.
struct Turns {
  std::vector<std::array<double, 2>> turn;
  std::vector<std::array<int, 2>> after;
};

Turns find_turns(const Mesh& mesh, const std::vector<Vec3>& position) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  Turns turns{std::vector(nodes, std::array{0.0, 0.0}), std::vector(nodes, std::array{-1, -1})};
  const std::vector<Bend> bends = find_bends(mesh, std::vector<char>(nodes, 0));
  const auto curvature = curvatures(bends, position);
  for (std::size_t b = 0; b < bends.size(); ++b) {
    for (std::size_t f = 0; f < 2; ++f) {
      const YarnBend& yarn = bends[b].yarn[f];
      if (yarn.yarns == 0.0) continue;
      turns.turn[bends[b].node][f] = curvature[b][2 * f + 1] * yarn.spread;
      turns.after[bends[b].node][f] = yarn.after;
    }
  }
  return turns;
}

}  // namespace

std::optional<Folds> find_folds(const Scene& scene, const Mesh& mesh, const std::vector<Vec3>& position) {
  if (!scene.tools.empty()) return {};
  Folds folds;
  const Turns turns = find_turns(mesh, position);
  std::vector<bool> zigzags(position.size(), false);
  for (std::size_t n = 0; n < position.size(); ++n) {
    folds.out_of_plane = std::max(folds.out_of_plane, std::abs(position[n][2] - mesh.nodes.position[n][2]));
    for (std::size_t f = 0; f < 2; ++f) {
      const int next = turns.after[n][f];
      if (next < 0 || turns.turn[n][f] * turns.turn[next][f] >= 0.0) continue;
      const double height = 0.5 * distance(position[n], position[next]) *
                            std::min(std::abs(turns.turn[n][f]), std::abs(turns.turn[next][f]));
      folds.zigzag_height = std::max(folds.zigzag_height, height);
      if (height > mesh.thickness) zigzags[n] = zigzags[next] = true;
    }
  }
  folds.zigzag_share = area_share(mesh, zigzags);
  return folds;
}

}  // namespace weaveform
