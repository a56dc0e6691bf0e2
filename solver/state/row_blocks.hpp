// How loops over rows are shared out and buffered: blocks of rows for threads, one row of element forces at a time.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "solver/state/packed.hpp"
#include "solver/state/state.hpp"

namespace weaveform {

// One row of element forces, readable at index -1 (the element left of the first one does not exist: zero) and at
// index stride.
class RowBuffer {
public:
  explicit RowBuffer(int stride) : storage_(static_cast<std::size_t>(stride) + 2 * guard, 0.0) {}
  [[nodiscard]] double* data() { return storage_.data() + guard; }
  void clear(Run range) { std::fill(data() + range.begin - 1, data() + range.end, 0.0); }

  // Outside of it everything is zero, from index -1 to `stride`; clear_gaps() keeps it so.
  Run filled = {0, 0};

private:
  static constexpr int guard = 8;  // a cache line, so that data() stays aligned
  Doubles storage_;
};

// One buffer per component.
using RowVectors = std::array<RowBuffer, 3>;
[[nodiscard]] inline RowVectors row_vectors(int stride) {
  return {RowBuffer(stride), RowBuffer(stride), RowBuffer(stride)};
}

// Clears what no run of the row writes, from index -1 to `stride`; the runs themselves are about to be overwritten, and
// nothing else is written, so that rows with the same single run have little to clear. Rows outside the lattice have no
// runs.
void clear_gaps(RowVectors& buffers, const RowRuns& runs, int row, int stride);

[[nodiscard]] Run united(Run a, Run b);

// Items of so much work each in shares of about equal work, one share a thread: share t has the items first[t] to
// first[t + 1] - 1.
[[nodiscard]] std::vector<int> balanced_shares(const std::vector<int>& work, int threads);

// Rows in blocks of about equal numbers of nodes.
[[nodiscard]] std::vector<int> balanced_blocks(const PackedMesh& packed, int threads);

}  // namespace weaveform
