#include "mesher/exchange/cell_springs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/vector/vector.hpp"

namespace weaveform::foreign {

namespace {

struct Pair {
  std::array<int, 2> node = {-1, -1};
  int mirror = -1;  // >= 0: the first of the two is mirrored in this node
  double along = 0.0, across = 0.0;
  [[nodiscard]] double product() const { return along * across; }
  [[nodiscard]] double ratio() const { return product() / (along * along + across * across); }
};

Vec3 mirrored(const Vec3& through, const Vec3& of) {
  return {2.0 * through[0] - of[0], 2.0 * through[1] - of[1], 2.0 * through[2] - of[2]};
}

Pair pair_of(const Gathered& model, int a, int b, int mirror) {
  const auto& x = model.mesh.flat_positions();
  const Vec3 way = minus(x[b], mirror < 0 ? x[a] : mirrored(x[mirror], x[a]));
  return {{a, b}, mirror, dot(way, model.direction[0]), dot(way, model.direction[1])};
}

// Keeps the pairs that lengthen ([0]) and shorten ([1]) most as the cell shears.
void keep_best(const Pair& pair, std::array<Pair, 2>& best) {
  if (pair.product() > best[0].product()) best[0] = pair;
  if (pair.product() < best[1].product()) best[1] = pair;
}

std::array<Pair, 2> best_pairs(const Gathered& model, int cell) {
  const auto& cells = model.mesh.cells;
  const int begin = cells.offset[cell], end = cells.offset[cell + 1];
  std::array<Pair, 2> own, best;
  for (int k = begin; k < end; ++k)
    for (int l = k + 1; l < end; ++l) keep_best(pair_of(model, cells.node[k], cells.node[l], -1), own);
  const double most = std::max(own[0].product(), -own[1].product());
  constexpr double enough = 0.3;  // of the better diagonal, for a pair of the cell's own nodes
  if (std::min(own[0].product(), -own[1].product()) >= enough * most) return own;
  best = own;
  for (int k = begin; k < end; ++k)
    for (int l = begin; l < end; ++l)
      for (int m = begin; m < end; ++m)
        if (k != l && m != k && m != l) keep_best(pair_of(model, cells.node[k], cells.node[l], cells.node[m]), best);
  const std::size_t strong = own[0].product() >= -own[1].product() ? 0 : 1;
  if (own[strong].product() != 0.0) best[strong] = own[strong];
  return best;
}

void add_spring(const Pair& pair, std::array<int, 2> node, double tilt, double volume, double start,
                CellSprings& springs) {
  const auto agree = [](double a, double b) { return std::abs(a - b) <= 1e-8 * std::abs(b); };
  for (auto& group : springs.group) {
    const bool same_law = agree(pair.product(), group.along * group.across) &&
                          agree(std::hypot(pair.along, pair.across), std::hypot(group.along, group.across));
    if (!same_law || !agree(tilt, group.tilt) || !agree(volume, group.volume) || !agree(start, group.start)) continue;
    group.node.push_back(node);
    return;
  }
  springs.group.push_back({pair.along, pair.across, tilt, volume, start, {node}});
}

}  // namespace

CellSprings cell_springs(const Gathered& model) {
  const Mesh& mesh = model.mesh;
  const auto& x = mesh.nodes.position;
  CellSprings springs;
  std::map<std::array<int, 2>, int> number;  // of a mirrored node, by (through, of)
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto pairs = best_pairs(model, cell);
    const double size = 0.5 * (std::abs(pairs[0].ratio()) + std::abs(pairs[1].ratio()));
    for (const Pair& pair : pairs) {
      if (pair.product() == 0.0)
        throw InputError(
            fmt::format("cell {}: none of its nodes lie across it, so that springs cannot carry its "
                        "shear; change blank.phase or blank.fit",
                        cell));
      std::array<int, 2> node = pair.node;
      Vec3 first = x[node[0]];
      if (pair.mirror >= 0) {
        first = mirrored(x[pair.mirror], first);
        const int next = mesh.node_count() + static_cast<int>(springs.mirrored.size());
        const auto [found, added] = number.emplace(std::array{pair.mirror, node[0]}, next);
        if (added) springs.mirrored.push_back({pair.mirror, node[0]});
        node[0] = found->second;
      }
      const Vec3 way = minus(x[node[1]], first);
      add_spring(pair, node, std::copysign(size, pair.product()), mesh.cells.area[cell] * mesh.thickness, length(way),
                 springs);
    }
  }
  return springs;
}

Points spring_points(const Gathered& model, const CellSpringGroup& group, std::size_t most) {
  const double squares = group.along * group.along + group.across * group.across;
  const double product = group.along * group.across;
  std::vector<double> knots = cell_knots(model, far_angle(model));
  if (product < 0.0) std::reverse(knots.begin(), knots.end());
  for (double& knot : knots) knot = std::sqrt(std::max(0.0, squares + 2.0 * product * knot)) - group.start;
  const auto law = [&](double elongation) {
    const double d = group.start + elongation;
    const double sine = (d * d - squares) / (2.0 * product);
    const double share = 0.5 - group.tilt * sine;
    return group.volume * share * cell_stress(model, sine) * d / product;
  };
  const double typical = group.volume * std::abs(cell_stress(model, 0.5)) * std::sqrt(squares) / std::abs(product);
  return fitted_points(law, knots, 1e-5 * typical, most);
}

}  // namespace weaveform::foreign
