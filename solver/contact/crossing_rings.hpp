// Each crossing of a ply with the eight around it, and the quads between them, as they are in the whole ply: beyond a
// mirror plane crossings are images of those on this side.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/vector/vector.hpp"
#include "solver/ply/ply.hpp"

namespace weaveform {

struct RingCrossing {
  int node = -1;        // packed
  unsigned planes = 0;  // its image in every mirror plane whose bit is set
};
using CrossingRing =
    std::array<RingCrossing, 9>;  // 3 * row + column, from south-west on; the fifth is the crossing itself

// Quads around a crossing.
inline constexpr unsigned south_west = 1, south_east = 2, north_west = 4, north_east = 8, all_four = 15;

class CrossingRings {
public:
  explicit CrossingRings(const Ply& ply);

  // Of a crossing's packed node; 0 where there is none.
  [[nodiscard]] unsigned quads(int node) const { return quads_[node]; }
  [[nodiscard]] int size() const { return static_cast<int>(quads_.size()); }
  [[nodiscard]] int stride() const { return stride_; }
  // Null where the ring is of the nodes around it in the packed lattice. What there is not stands for the crossing.
  [[nodiscard]] const CrossingRing* special(int node) const {
    return special_[node] < 0 ? nullptr : &special_ring_[static_cast<std::size_t>(special_[node])];
  }
  [[nodiscard]] RingCrossing at(int node, int place) const {
    const CrossingRing* const ring = special(node);
    return ring != nullptr ? (*ring)[static_cast<std::size_t>(place)]
                           : RingCrossing{node + (place / 3 - 1) * stride_ + place % 3 - 1, 0};
  }
  [[nodiscard]] Vec3 position(const RingCrossing& crossing, const Components& position) const {
    const Vec3 there = {position[0][crossing.node], position[1][crossing.node], position[2][crossing.node]};
    return crossing.planes == 0 ? there : plus(origin_[crossing.planes], mirrored(there, crossing.planes));
  }
  [[nodiscard]] Vec3 mirrored(const Vec3& vector, unsigned planes) const { return times(mirror_[planes], vector); }

private:
  int stride_;
  std::vector<std::uint8_t> quads_;
  std::vector<int> special_;  // number of its ring; -1
  std::vector<CrossingRing> special_ring_;
  std::vector<std::array<Vec3, 3>> mirror_;  // rows, for every set of planes
  std::vector<Vec3> origin_;                 // mm; image of 0
};

}  // namespace weaveform
