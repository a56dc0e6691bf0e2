// What a sweep keeps of one band of rows (bands.hpp): its element forces until they are assembled, and its sums.
#pragma once

#include <algorithm>
#include <array>

#include "solver/lattice/element_loops.hpp"
#include "solver/lattice/node_loops.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// The element forces of one band, N, in double or in single precision: on a slot's node by the warp element that starts
// there, by the weft element, and the two of the cell (element_loops.hpp). Slot n stands at n - origin, readable from one
// slot before the band to one behind it.
template <class Real>
class BandForces {
public:
  explicit BandForces(int slots) {
    for (auto& array : array_) array.assign(slots + 2 * guard, Real{0});
  }
  void place(int origin) { origin_ = origin; }
  [[nodiscard]] int origin() const { return origin_; }
  // Component c.
  Real* along(int c) { return array_[c].data() + guard; }
  Real* across(int c) { return array_[3 + c].data() + guard; }
  Real* p(int c) { return array_[6 + c].data() + guard; }
  Real* q(int c) { return array_[9 + c].data() + guard; }

  static constexpr int along_arrays = 3, between_arrays = 9;
  [[nodiscard]] std::array<Real*, along_arrays> along_array() { return {along(0), along(1), along(2)}; }
  [[nodiscard]] std::array<Real*, between_arrays> between_array() {
    return {across(0), across(1), across(2), p(0), p(1), p(2), q(0), q(1), q(2)};
  }
  [[nodiscard]] RowForces<Real> row() {
    return {{along(0), along(1), along(2)},
            {across(0), across(1), across(2)},
            {p(0), p(1), p(2)},
            {q(0), q(1), q(2)},
            origin_};
  }

private:
  static constexpr int guard =
      64 / sizeof(Real);  // a cache line, so that slots stay aligned; a block that clears ends in it
  std::array<std::vector<Real, CacheLineAllocator<Real>>, 12> array_;
  int origin_ = 0;
};

// Over the elements of one band: the same lanes for any number of threads.
struct BandSums {
  std::array<YarnLanes, 2> yarns;  // warp, weft
  CellLanes cells;
  BandSums() {
    for (YarnLanes& family : yarns)
      for (int l = 0; l < lane_count; ++l) {
        family.power[l] = 0.0;
        family.shortest[l] = family.longest[l] = 1.0;
      }
    for (double& sharpest : cells.sharpest) sharpest = 0.0;
  }
};

struct YarnSums {
  double power = 0.0;                    // mJ/s; of the yarns' viscosity
  double shortest = 1.0, longest = 1.0;  // 1; least and greatest (L/L0)^2

  void add(const YarnLanes& more) {
    for (int l = 0; l < lane_count; ++l) {
      power += more.power[l];
      shortest = std::min(shortest, more.shortest[l]);
      longest = std::max(longest, more.longest[l]);
    }
  }
};

}  // namespace weaveform
