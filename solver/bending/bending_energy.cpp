#include "solver/bending/bending_energy.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <map>

#include "core/vector/eigen_vector.hpp"
#include "solver/state/packed.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

// The change of tangent of one family, and its curvature's factor: kappa = factor * part of c.
struct Turn {
  Vector3d c = Vector3d::Zero();
  double factor = 0.0;
};

Turn turn_of(const YarnBend& yarn, int node, const std::vector<Vec3>& position) {
  if (yarn.yarns == 0.0) return {};
  const Vector3d x = vector_of(position[node]);
  const Vector3d before =
      yarn.fixed_before ? vector_of(yarn.fixed) : unit_or_zero(x - vector_of(position[yarn.before]));
  const Vector3d after = yarn.fixed_after ? vector_of(yarn.fixed) : unit_or_zero(vector_of(position[yarn.after]) - x);
  Turn turn{after - before, 0.0};
  const double u = turn.c.squaredNorm();
  turn.factor = std::sqrt(1.0 + u / 12 + u * u / 90 + u * u * u / 560) / yarn.spread;
  return turn;
}

// From the yarn's node before to that after; in jaws it goes on as far as outside.
Vector3d span_of(const YarnBend& yarn, const std::vector<Vec3>& position) {
  return vector_of(position[yarn.after]) - vector_of(position[yarn.before]) + 2.0 * yarn.spread * vector_of(yarn.fixed);
}

Vector3d plane_normal(const Bend& bend, const std::vector<Vec3>& position) {
  return unit_or_zero(span_of(bend.yarn[0], position).cross(span_of(bend.yarn[1], position)));
}

// in, out; out is positive where the yarn turns towards the normal: the other side is bent outwards then
std::array<double, 2> parts(const Turn& turn, const Vector3d& normal) {
  const double out = turn.c.dot(normal);
  const double in = std::sqrt(std::max(0.0, turn.c.squaredNorm() - out * out));
  return {turn.factor * in, turn.factor * out};
}

}  // namespace

std::vector<TwistCell> find_twist_cells(const Mesh& mesh) {
  std::vector<TwistCell> cells;
  std::map<std::array<int, 2>, int> at;
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (!is_full_quad(mesh, c)) continue;
    const int* node = mesh.cells.node.data() + mesh.cells.offset[c];
    at[mesh.cells.lattice[c]] = static_cast<int>(cells.size());
    cells.push_back({{node[0], node[1], node[2], node[3]}, mesh.cells.area[c]});
  }
  if (cells.empty()) return cells;
  constexpr std::array<std::array<int, 2>, 8> around = {
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (is_full_quad(mesh, c)) continue;
    std::vector<int> beside;
    // edge neighbours if there are any, else the corner's
    for (std::size_t k = 0; k < around.size() && (k < 4 || beside.empty()); ++k) {
      const auto found = at.find({mesh.cells.lattice[c][0] + around[k][0], mesh.cells.lattice[c][1] + around[k][1]});
      if (found != at.end()) beside.push_back(found->second);
    }
    for (const int b : beside) cells[b].area += mesh.cells.area[c] / static_cast<double>(beside.size());
  }
  return cells;
}

double bending_energy(const std::vector<Bend>& bends, const Flexure& flexure, const std::vector<Vec3>& position) {
  double energy = 0.0;
  for (const auto& bend : bends) {
    const Vector3d normal = plane_normal(bend, position);
    for (int f = 0; f < 2; ++f) {
      const YarnBend& yarn = bend.yarn[f];
      const auto [in, out] = parts(turn_of(yarn, bend.node, position), normal);
      energy += yarn.yarns * yarn.spread * (flexure.in_plane[f].energy(in) + flexure.out_of_plane[f].energy(-out));
    }
  }
  return energy;
}

double twist_energy(const std::vector<TwistCell>& cells, double twist, const std::array<double, 2>& spacing,
                    const std::vector<Vec3>& position) {
  double energy = 0.0;
  for (const auto& cell : cells) {
    const Vector3d x00 = vector_of(position[cell.node[0]]), x10 = vector_of(position[cell.node[1]]),
                   x11 = vector_of(position[cell.node[2]]), x01 = vector_of(position[cell.node[3]]);
    const Vector3d normal = unit_or_zero((x11 - x00).cross(x01 - x10));
    const double curvature = (x00 - x10 - x01 + x11).dot(normal) / (spacing[0] * spacing[1]);
    energy += 2.0 * twist * cell.area * curvature * curvature;
  }
  return energy;
}

std::vector<std::array<double, 4>> curvatures(const std::vector<Bend>& bends, const std::vector<Vec3>& position) {
  std::vector<std::array<double, 4>> result;
  for (const auto& bend : bends) {
    const Vector3d normal = plane_normal(bend, position);
    const auto warp = parts(turn_of(bend.yarn[0], bend.node, position), normal);
    const auto weft = parts(turn_of(bend.yarn[1], bend.node, position), normal);
    result.push_back({warp[0], warp[1], weft[0], weft[1]});
  }
  return result;
}

}  // namespace weaveform
