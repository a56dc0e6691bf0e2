#include "solver/state/row_blocks.hpp"

namespace weaveform {

void clear_gaps(RowVectors& buffers, const RowRuns& runs, int row, int stride) {
  const bool inside = row >= 0 && row + 1 < static_cast<int>(runs.first.size());
  for (auto& component : buffers) {
    int from = 0;
    if (inside)
      for (int r = runs.first[row]; r < runs.first[row + 1]; ++r) {
        component.clear({from, runs.run[r].begin});
        from = runs.run[r].end + 1;
      }
    component.clear({from, stride + 1});
  }
}

Run united(Run a, Run b) {
  if (a.begin == a.end) return b;
  if (b.begin == b.end) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

std::vector<int> balanced_blocks(const PackedMesh& packed, int threads) {
  long total = 0;
  for (int j = 0; j < packed.rows; ++j) total += packed.span(j).end - packed.span(j).begin;
  std::vector<int> first = {0};
  long sum = 0;
  for (int j = 0; j < packed.rows; ++j) {
    sum += packed.span(j).end - packed.span(j).begin;
    if (sum * threads >= total * static_cast<long>(first.size()) && static_cast<int>(first.size()) < threads)
      first.push_back(j + 1);
  }
  first.resize(threads, packed.rows);
  first.push_back(packed.rows);
  return first;
}

}  // namespace weaveform
