#include "mesher/drape/tight_bends.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/drape/regions.hpp"

namespace weaveform {
namespace {

using Eigen::Vector3d;

constexpr int halvings = 10;
constexpr double least_turn = 0.1;  // rad; over an element; yarns nearly along a bend's axis turn less and tell little
constexpr double crease = 0.02;     // of the cell side; a radius below it is none

struct End {
  Vector3d x, normal;
};

double turn(const End& a, const End& b) {
  return std::atan2(a.normal.cross(b.normal).norm(), a.normal.dot(b.normal));
}

// Across the bend, whichever way the yarn crosses it: along the direction in which the normal turns.
double radius_between(const End& a, const End& b) {
  const Vector3d by = b.normal - a.normal;
  const double square = by.squaredNorm();
  return square > 0.0 ? std::abs((b.x - a.x).dot(by)) / square : INFINITY;
}

struct Bend {
  double radius = INFINITY;  // mm; of the tool
  Vector3d at = Vector3d::Zero();
};

// Halves the element as long as most of the turn lies in one half, then looks across the bend: the direction in which
// the normal turns tends to that of the greatest curvature (power iteration).
Bend sharpest(const DrapeSurface& surface, double offset, End a, End b, int& hint) {
  const auto end_at = [&](const Vector3d& near, End& end) {
    end.x = near;
    if (!project(surface, end.x, hint)) return false;
    end.normal = surface.at(end.x, hint).gradient.normalized();
    return true;
  };
  End middle;
  for (int n = 0; n < halvings && end_at(0.5 * (a.x + b.x), middle); ++n) {
    const bool first = turn(a, middle) > turn(middle, b);
    const End &from = first ? a : middle, &to = first ? middle : b;
    if (turn(from, to) < 0.75 * turn(a, b)) break;
    (first ? b : a) = middle;
  }
  const Vector3d centre = 0.5 * (a.x + b.x);
  const double half = 0.5 * (b.x - a.x).norm();
  for (int n = 0; n < 3; ++n) {
    const Vector3d across = half * (b.normal - a.normal).normalized();
    const double sense = across.dot(b.x - a.x) < 0.0 ? -1.0 : 1.0;
    End from, to;
    if (!end_at(centre - sense * across, from) || !end_at(centre + sense * across, to) || turn(from, to) == 0.0) break;
    a = from;
    b = to;
  }
  const bool bulges = (b.x - a.x).dot(b.normal - a.normal) > 0.0;
  return {std::max(0.0, radius_between(a, b) + (bulges ? -offset : offset)), centre};
}

}  // namespace

std::vector<DrapePlace> tight_bends(const DrapeSurface& surface, double offset, const DrapedNet& net,
                                    const std::array<double, 2>& spacing, const std::vector<char>& in_blank) {
  const NetBox& box = net.box;
  int hint = 0;
  std::vector<Vector3d> normal(net.position.size());
  const auto there = [&](std::size_t k) { return net.placed[k] == Placed::yes && in_blank[k] != 0; };
  for (std::size_t k = 0; k < normal.size(); ++k)
    if (there(k)) normal[k] = surface.at(net.position[k], hint).gradient.normalized();

  std::vector<char> marked(net.position.size(), 0);
  std::vector<Bend> bend(net.position.size());
  for (int j = 0; j < box.size[1]; ++j)
    for (int i = 0; i < box.size[0]; ++i)
      for (int f = 0; f < 2; ++f) {
        if (i + 1 - f >= box.size[0] || j + f >= box.size[1]) continue;
        const std::size_t here = static_cast<std::size_t>(j) * box.size[0] + i,
                          next = here + (f == 0 ? 1 : box.size[0]);
        if (!there(here) || !there(next)) continue;
        const End a{net.position[here], normal[here]}, b{net.position[next], normal[next]};
        if (turn(a, b) < least_turn || radius_between(a, b) >= least_radius_in_cells * spacing[f]) continue;
        const Bend found = sharpest(surface, offset, a, b, hint);
        if (found.radius >= least_radius_in_cells * spacing[f]) continue;
        marked[here] = 1;
        if (found.radius < bend[here].radius) bend[here] = found;
      }

  std::vector<DrapePlace> places;
  const double side = std::max(spacing[0], spacing[1]);
  for (const Region& region : connected_regions(marked, box.size, {-box.low[0], -box.low[1]})) {
    // the region's place is its entry nearest to the seed, with the radius there
    const Bend& at = bend[static_cast<std::size_t>(region.first[1]) * box.size[0] + region.first[0]];
    const double cells = at.radius / side;
    // the rule of drape.hpp, at its worst angle
    const double invented = 180.0 / std::numbers::pi / 12.0 / (cells * cells);
    places.push_back(
        {at.radius < crease * side
             ? "the tool has a sharp edge here, where chords shear whatever their length; round it"
             : fmt::format("the tool's radius of about {:.2g} mm is {:.2g} cell sides (3 are wanted): {}; make "
                           "blank.coarsening smaller",
                           at.radius, cells,
                           cells >= 1.0 ? fmt::format("chords invent up to {:.2g} deg of shear", invented)
                                        : "chords invent shear of any size"),
         {at.at[0], at.at[1], at.at[2]},
         region.count});
  }
  return places;
}

}  // namespace weaveform
