#include "solver/state/row_blocks.hpp"

#include <numeric>

namespace weaveform {

void clear_gaps(RowVectors& buffers, const RowRuns& runs, int row, int stride) {
  const bool inside = row >= 0 && row + 1 < static_cast<int>(runs.first.size());
  const int first = inside ? runs.first[row] : 0, last = inside ? runs.first[row + 1] : 0;
  const Run filled = last == first ? Run{0, 0} : Run{runs.run[first].begin, runs.run[last - 1].end};
  const bool has_gaps_inside = last > first + 1;
  for (auto& component : buffers) {
    if (!has_gaps_inside && component.filled.begin == filled.begin && component.filled.end == filled.end) continue;
    int from = 0;
    for (int r = first; r < last; ++r) {
      component.clear({from, runs.run[r].begin});
      from = runs.run[r].end + 1;
    }
    component.clear({from, stride + 1});
    component.filled = filled;
  }
}

Run united(Run a, Run b) {
  if (a.begin == a.end) return b;
  if (b.begin == b.end) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

std::vector<int> balanced_shares(const std::vector<int>& work, int threads) {
  const long total = std::accumulate(work.begin(), work.end(), 0L);
  const int items = static_cast<int>(work.size());
  std::vector<int> first = {0};
  long sum = 0;
  for (int k = 0; k < items; ++k) {
    sum += work[k];
    if (sum * threads >= total * static_cast<long>(first.size()) && static_cast<int>(first.size()) < threads)
      first.push_back(k + 1);
  }
  first.resize(threads, items);
  first.push_back(items);
  return first;
}

std::vector<int> balanced_blocks(const PackedMesh& packed, int threads) {
  std::vector<int> nodes;
  for (int j = 0; j < packed.rows; ++j) nodes.push_back(packed.span(j).end - packed.span(j).begin);
  return balanced_shares(nodes, threads);
}

}  // namespace weaveform
