#include "mesher/drape/net.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mesher/drape/generator.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

// One quarter of the lattice, its corner at the seed.
struct Quarter {
  int i, j;                      // +1 or -1
  std::array<int, 2> last = {};  // farthest index along each generator
};

std::array<Quarter, 4> quarters(const NetBox& box) {
  std::array<Quarter, 4> all = {{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
  for (auto& q : all) {
    q.last[0] = q.i > 0 ? box.low[0] + box.size[0] - 1 : -box.low[0];
    q.last[1] = q.j > 0 ? box.low[1] + box.size[1] - 1 : -box.low[1];
  }
  return all;
}

void lay_generators(const DrapeSurface& surface, const NetStart& start, const std::vector<char>& needed,
                    DrapedNet& net) {
  int hint = 0;
  Vector3d normal = surface.normal(start.seed, hint);
  if (normal.dot(start.normal) < 0.0) normal = -normal;
  const Vector3d warp = (start.warp - start.warp.dot(normal) * normal).normalized();
  const std::array<Vector3d, 2> direction = {warp, normal.cross(warp)};
  const NetBox& box = net.box;
  net.position[box.index(0, 0)] = start.seed;
  net.placed[box.index(0, 0)] = Placed::yes;
  for (std::size_t f = 0; f < 2; ++f)
    for (const int side : {0, 1}) {
      const int sign = side == 0 ? 1 : -1;
      const auto at = [&](int k) { return f == 0 ? box.index(sign * k, 0) : box.index(0, sign * k); };
      const int end = sign > 0 ? box.low[f] + box.size[f] - 1 : -box.low[f];
      int count = 0;
      for (int k = 1; k <= end; ++k)
        if (needed[at(k)] != 0) count = k;
      const auto& curve = start.curve[f][side];
      const Generator yarn = curve.empty()
                                 ? geodesic(surface, start.seed, Vector3d(sign * direction[f]), start.spacing[f], count)
                                 : along_curve(surface, start.seed, curve, start.spacing[f], count);
      const int laid = static_cast<int>(yarn.node.size());
      for (int k = 1; k <= count; ++k) {
        net.placed[at(k)] = k > laid + 1 ? Placed::behind : Placed::nothing;
        if (k > laid) continue;
        net.position[at(k)] = yarn.node[k - 1];
        net.placed[at(k)] = yarn.beyond[k - 1] != 0 ? Placed::past_rim : Placed::yes;
      }
    }
}

// The fourth crossing of a cell: at the warp spacing from `beside` (its neighbour along the warp) and at the weft
// spacing from `below`.
Placed fourth(const DrapeSurface& surface, const NetStart& start, const Vector3d& corner, const Vector3d& below,
              const Vector3d& beside, Vector3d& x, int& hint) {
  const double a = start.spacing[0], b = start.spacing[1];
  const Vector3d across = below - beside;
  const double square = across.squaredNorm();
  if (!(square > 1e-24 * a * a)) return Placed::nothing;  // the two neighbours are one
  // on the spheres' common circle (x - beside).across is the same everywhere
  const double share = 0.5 * (square + a * a - b * b) / square;
  const double radius2 = a * a - share * share * square;
  if (!(radius2 > 0.0)) return Placed::nothing;
  Circle circle;
  circle.radius = std::sqrt(radius2);
  circle.centre = beside + share * across;
  const Vector3d axis = across / std::sqrt(square);
  Vector3d out = below + beside - corner - circle.centre;  // to the parallelogram's corner
  out -= out.dot(axis) * axis;
  const double size = out.norm();
  if (!(size > 1e-9 * a)) return Placed::nothing;
  circle.e1 = out / size;
  circle.e2 = axis.cross(circle.e1);
  const CircleMeets met = meet(surface, circle, x, hint);
  if (met == CircleMeets::surface) return Placed::yes;
  return met == CircleMeets::past_rim ? Placed::past_rim : Placed::nothing;
}

void fill_quarter(const DrapeSurface& surface, const NetStart& start, const Quarter& q, const std::vector<char>& needed,
                  DrapedNet& net) {
  const NetBox& box = net.box;
  int hint = 0;
  for (int b = 1; b <= q.last[1]; ++b)
    for (int a = 1; a <= q.last[0]; ++a) {
      const std::size_t here = box.index(q.i * a, q.j * b);
      if (needed[here] == 0) continue;
      const std::size_t corner = box.index(q.i * (a - 1), q.j * (b - 1)), below = box.index(q.i * a, q.j * (b - 1)),
                        beside = box.index(q.i * (a - 1), q.j * b);
      const auto carries = [&](std::size_t k) {
        return net.placed[k] == Placed::yes || net.placed[k] == Placed::past_rim;
      };
      const bool known = carries(corner) && carries(below) && carries(beside);
      net.placed[here] = known ? fourth(surface, start, net.position[corner], net.position[below], net.position[beside],
                                        net.position[here], hint)
                               : Placed::behind;
    }
}

}  // namespace

// Every crossing that a wanted one hangs on is needed too.
std::vector<char> needed_crossings(const NetBox& box, const std::vector<char>& wanted) {
  std::vector<char> needed = wanted;
  for (const Quarter& q : quarters(box))
    for (int b = q.last[1]; b >= 0; --b)
      for (int a = q.last[0]; a >= 0; --a) {
        char& here = needed[box.index(q.i * a, q.j * b)];
        for (const auto& [da, db] : {std::pair(1, 0), {0, 1}, {1, 1}})
          if (a + da <= q.last[0] && b + db <= q.last[1] && needed[box.index(q.i * (a + da), q.j * (b + db))] != 0)
            here = 1;
      }
  return needed;
}

DrapedNet drape_net(const DrapeSurface& surface, const NetStart& start, const NetBox& box,
                    const std::vector<char>& wanted) {
  DrapedNet net;
  net.box = box;
  const std::size_t count = static_cast<std::size_t>(box.size[0]) * box.size[1];
  net.position.assign(count, Vector3d::Constant(std::nan("")));
  net.placed.assign(count, Placed::unwanted);
  const std::vector<char> needed = needed_crossings(box, wanted);
  lay_generators(surface, start, needed, net);
  for (const Quarter& q : quarters(box)) fill_quarter(surface, start, q, needed, net);
  return net;
}

}  // namespace weaveform
