#include "solver/state/row_blocks.hpp"

#include <gtest/gtest.h>

#include <random>

namespace weaveform {
namespace {

constexpr int row_length = 40, row_count = 12;

// Rows of no, one and several runs, some of them alike, and one from end to end.
RowRuns assorted_runs() {
  RowRuns runs{.first = {0}, .run = {}};
  const std::vector<std::vector<Run>> rows = {{{3, 30}},
                                              {{3, 30}},
                                              {},
                                              {{0, row_length}},
                                              {{0, 5}, {9, 12}, {20, row_length}},
                                              {{0, row_length}},
                                              {{3, 31}},
                                              {{2, 8}, {11, 30}},
                                              {{3, 30}},
                                              {{0, 1}},
                                              {},
                                              {{7, 9}}};
  for (const auto& row : rows) {
    runs.run.insert(runs.run.end(), row.begin(), row.end());
    runs.first.push_back(static_cast<int>(runs.run.size()));
  }
  return runs;
}

TEST(RowBlocks, ABufferHoldsTheRunsOfItsRowAndNothingElseWhateverRowsWereInItBefore) {
  const RowRuns runs = assorted_runs();
  RowVectors buffers = row_vectors(row_length);
  std::mt19937 random(7);
  for (int turn = 0; turn < 2000; ++turn) {
    const int row = std::uniform_int_distribution(-1, row_count)(random);  // one more on either side
    clear_gaps(buffers, runs, row, row_length);
    std::vector<bool> written(row_length, false);
    if (row >= 0 && row < row_count)
      for (int r = runs.first[row]; r < runs.first[row + 1]; ++r)
        for (int i = runs.run[r].begin; i < runs.run[r].end; ++i) {
          for (auto& component : buffers) component.data()[i] = turn + 1.0;
          written[i] = true;
        }
    for (auto& component : buffers) {
      EXPECT_EQ(component.data()[-1], 0.0) << row;
      EXPECT_EQ(component.data()[row_length], 0.0) << row;
      for (int i = 0; i < row_length; ++i)
        ASSERT_EQ(component.data()[i], written[i] ? turn + 1.0 : 0.0) << row << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace weaveform
