#include "mesher/drape/outline_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace weaveform {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

bool is_whole(const Mesh& mesh, int c) {
  const int begin = mesh.cells.offset[c], end = mesh.cells.offset[c + 1];
  if (end - begin != 4) return false;
  for (int a = begin; a < end; ++a)
    if (mesh.nodes.crossing[mesh.cells.node[a]][0] < 0) return false;
  return true;
}

// Places on the flat blank in steps of the lattice, crossing (0, 0) of the mesh as origin.
class FlatLattice {
public:
  explicit FlatLattice(const Mesh& mesh) : mesh_(mesh) {
    int first = 0;
    while (mesh.nodes.crossing[first][0] < 0) ++first;
    origin_ = flat(first);
    at_origin_ = Vector2d(mesh.nodes.crossing[first][0], mesh.nodes.crossing[first][1]);
    for (int e = 0; e < mesh.yarn_count(); ++e) {
      const auto [a, b] = mesh.yarns.node[e];
      const std::size_t f = mesh.yarns.family[e] == Family::warp ? 0 : 1;
      direction_[f] = (flat(b) - flat(a)).normalized();
    }
  }

  [[nodiscard]] Vector2d at(const Vector2d& place) const {
    const Vector2d off = place - origin_;
    return at_origin_ + Vector2d(off.dot(direction_[0]) / mesh_.spacing[0], off.dot(direction_[1]) / mesh_.spacing[1]);
  }

  // Centroid of the cell's polygon.
  [[nodiscard]] Vector2d centre(int c) const {
    const int begin = mesh_.cells.offset[c], end = mesh_.cells.offset[c + 1];
    const Vector2d base = flat(mesh_.cells.node[begin]);
    Vector2d moment = Vector2d::Zero();
    double twice_area = 0.0;
    for (int a = begin + 1; a + 1 < end; ++a) {
      const Vector2d p = flat(mesh_.cells.node[a]) - base, q = flat(mesh_.cells.node[a + 1]) - base;
      const double cross = p[0] * q[1] - p[1] * q[0];
      twice_area += cross;
      moment += cross / 3.0 * (p + q);
    }
    return at(twice_area > 0.0 ? Vector2d(base + moment / twice_area) : base);
  }

private:
  [[nodiscard]] Vector2d flat(int n) const {
    const auto& x = mesh_.flat_positions()[static_cast<std::size_t>(n)];
    return {x[0], x[1]};
  }

  const Mesh& mesh_;
  Vector2d origin_, at_origin_;
  std::array<Vector2d, 2> direction_ = {Vector2d::UnitX(), Vector2d::UnitY()};
};

// A whole cell of the net.
struct NetAngle {
  double angle = std::nan("");  // rad; not a number when a corner is missing
  bool beyond = false;          // a corner has no place on the tool
  [[nodiscard]] bool known() const { return !std::isnan(angle); }
};

class NetAngles {
public:
  NetAngles(const DrapedNet& net, const std::array<int, 2>& seed) : net_(net), seed_(seed) {}

  // The cell between the crossings (i, j) and (i + 1, j + 1) of the mesh's lattice.
  [[nodiscard]] NetAngle of(int i, int j) const {
    NetAngle cell;
    std::array<Vector3d, 4> x;
    for (int k = 0; k < 4; ++k) {
      const int a = i - seed_[0] + k % 2, b = j - seed_[1] + k / 2;
      if (!net_.box.holds(a, b)) return cell;
      const std::size_t n = net_.box.index(a, b);
      if (net_.placed[n] != Placed::yes && net_.placed[n] != Placed::past_rim) return cell;
      cell.beyond = cell.beyond || net_.placed[n] == Placed::past_rim;
      x[static_cast<std::size_t>(k)] = net_.position[n];
    }
    const Vector3d g1 = x[1] - x[0] + x[3] - x[2], g2 = x[2] - x[0] + x[3] - x[1];
    cell.angle = std::atan2(g1.dot(g2), g1.cross(g2).norm());
    return cell;
  }

  // Bilinear between the centres of the cell (i, j) and its neighbours on the side of `place`; a neighbour that is
  // missing goes on as the one opposite does.
  [[nodiscard]] NetAngle at(int i, int j, const Vector2d& place) const {
    NetAngle cell = of(i, j);
    if (!cell.known()) return cell;
    const Vector2d off = place - Vector2d(i + 0.5, j + 0.5);
    const int si = off[0] < 0.0 ? -1 : 1, sj = off[1] < 0.0 ? -1 : 1;
    const double s = std::abs(off[0]), t = std::abs(off[1]);
    const double along = beside(cell, of(i + si, j), of(i - si, j)),
                 across = beside(cell, of(i, j + sj), of(i, j - sj));
    const NetAngle corner = of(i + si, j + sj);
    const double twist = corner.known() ? corner.angle - along - across + cell.angle : 0.0;
    cell.angle += s * (along - cell.angle) + t * (across - cell.angle) + s * t * twist;
    return cell;
  }

private:
  static double beside(const NetAngle& cell, const NetAngle& neighbour, const NetAngle& opposite) {
    if (neighbour.known()) return neighbour.angle;
    return opposite.known() ? 2.0 * cell.angle - opposite.angle : cell.angle;
  }

  const DrapedNet& net_;
  std::array<int, 2> seed_;
};

}  // namespace

void want_outline_corners(const Mesh& mesh, const std::array<int, 2>& seed, const NetBox& box,
                          std::vector<char>& wanted) {
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (is_whole(mesh, c)) continue;
    const auto& [i, j] = mesh.cells.lattice[c];
    for (int k = 0; k < 4; ++k) {
      const int a = i - seed[0] + k % 2, b = j - seed[1] + k / 2;
      if (box.holds(a, b)) wanted[box.index(a, b)] = 1;
    }
  }
}

OutlineAngles outline_angles(const Mesh& mesh, const std::array<int, 2>& seed, const DrapedNet& net) {
  OutlineAngles found;
  found.angle.assign(static_cast<std::size_t>(mesh.cells.size()), std::nan(""));
  found.extrapolated.assign(found.angle.size(), 0);
  const FlatLattice lattice(mesh);
  const NetAngles angles(net, seed);
  for (int c = 0; c < mesh.cells.size(); ++c) {
    if (is_whole(mesh, c)) continue;
    const auto& [i, j] = mesh.cells.lattice[c];
    const NetAngle cell = angles.at(i, j, lattice.centre(c));
    found.angle[c] = cell.angle;
    found.extrapolated[c] = !cell.known() || cell.beyond ? 1 : 0;
  }
  return found;
}

}  // namespace weaveform
