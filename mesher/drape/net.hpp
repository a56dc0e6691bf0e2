// Pin-jointed kinematic draping: the crossings of a lattice of inextensible yarns laid on a surface. Two generator
// yarns through the seed are given; every other crossing is one of the two points of the surface at the yarn spacings
// from two neighbours (two spheres and the surface), taken as the continuation of the parallelogram. Lengths are kept
// to rounding.
//
// A net of equal chords always finds such a point, for the crossing before it is one: where the smooth net would lock,
// its cells turn over and it folds back in silence. So the net itself never complains; whoever uses it looks at the
// orientation of its cells.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "mesher/drape/surface.hpp"

namespace weaveform {

struct NetStart {
  Eigen::Vector3d seed = Eigen::Vector3d::Zero();     // mm; on the surface
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // the fabric's upper side at the seed; only its sense counts
  Eigen::Vector3d warp =
      Eigen::Vector3d::UnitX();                // need not be tangent, must not be normal; the weft is at right angles
  std::array<double, 2> spacing = {1.0, 1.0};  // mm; chord lengths along warp (i) and weft (j)
  // mm; [family][0 forward, 1 back] given curves that leave the seed; empty: geodesics
  std::array<std::array<std::vector<Eigen::Vector3d>, 2>, 2> curve;
};

enum class Placed : std::uint8_t {
  yes,
  nothing,   // no point of the surface within reach
  past_rim,  // past the rim of an open surface or over a hole: its position carries the net on, but nothing lies there
  behind,    // hangs on a crossing that has no place
  unwanted,  // neither asked for nor needed on the way to one that is
};

// Crossings low <= (i, j) <= low + size - 1 about the seed, which is (0, 0) and inside.
struct NetBox {
  std::array<int, 2> low = {0, 0}, size = {1, 1};
  [[nodiscard]] std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j - low[1]) * size[0] + (i - low[0]);
  }
  [[nodiscard]] bool holds(int i, int j) const {
    return i >= low[0] && j >= low[1] && i < low[0] + size[0] && j < low[1] + size[1];
  }
};

struct DrapedNet {
  NetBox box;
  std::vector<Eigen::Vector3d> position;  // mm
  std::vector<Placed> placed;
};

// `wanted` and the crossings on the way from the generators to a wanted one.
[[nodiscard]] std::vector<char> needed_crossings(const NetBox& box, const std::vector<char>& wanted);

// `wanted`: one flag a crossing of the box; those on the way from the generators to a wanted one are laid too.
[[nodiscard]] DrapedNet drape_net(const DrapeSurface& surface, const NetStart& start, const NetBox& box,
                                  const std::vector<char>& wanted);

}  // namespace weaveform
