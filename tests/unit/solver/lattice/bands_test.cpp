// Bands and blocks hold every element once, and every slot that assembling reads is computed or cleared.
#include "solver/lattice/bands.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/fabric_patch.hpp"

namespace weaveform {
namespace {

// Slots that the blocks of a row hold, and those cleared beside them.
std::set<int> slots_of(const PerRow<int>& blocks, int row) {
  std::set<int> slots;
  for (int k = blocks.first[row]; k < blocks.first[row + 1]; ++k)
    for (int l = 0; l < vector_width; ++l) slots.insert(blocks.item[k] + l);
  return slots;
}

std::set<int> with_gaps(std::set<int> slots, const PerRow<int>& gaps, int row) {
  slots.merge(slots_of(gaps, row));
  return slots;
}

class BandsOfPatch : public testing::TestWithParam<double> {
protected:
  const test::FabricPatch patch{"twintex-pw", GetParam(), {90.0, 140.0}};
  const PackedMesh& packed = patch.packed;
  const Bands bands = make_bands(packed);
};
INSTANTIATE_TEST_SUITE_P(Angles, BandsOfPatch, testing::Values(0.0, 17.0, 45.0, 90.0));

TEST_P(BandsOfPatch, HoldEveryElementOnce) {
  for (int j = 0; j < packed.rows; ++j) {
    const auto warp = slots_of(bands.warp, j), between = slots_of(bands.between, j);
    for (int i = 0; i < packed.stride; ++i) {
      const int n = j * packed.stride + i;
      EXPECT_TRUE(packed.warp_section[n] == 0.0 || warp.count(n) == 1) << i << ", " << j;
      EXPECT_TRUE(packed.weft_section[n] == 0.0 || between.count(n) == 1) << i << ", " << j;
      EXPECT_TRUE(packed.cell_area[n] == 0.0 || between.count(n) == 1) << i << ", " << j;
    }
  }
}

TEST_P(BandsOfPatch, HoldNoSlotTwiceAndNoneOfAnotherRow) {
  for (const auto* blocks : {&bands.nodes, &bands.warp, &bands.between})
    for (int j = 0; j < packed.rows; ++j) {
      const auto slots = slots_of(*blocks, j);
      EXPECT_EQ(slots.size(), static_cast<std::size_t>(vector_width * (blocks->first[j + 1] - blocks->first[j])));
      if (slots.empty()) continue;
      EXPECT_GE(*slots.begin(), j * packed.stride);
      EXPECT_LT(*slots.rbegin(), (j + 1) * packed.stride);
    }
}

TEST_P(BandsOfPatch, HoldEveryNode) {
  for (int j = 0; j < packed.rows; ++j) {
    const auto slots = slots_of(bands.nodes, j);
    for (int r = packed.node_runs.first[j]; r < packed.node_runs.first[j + 1]; ++r)
      for (int i = packed.node_runs.run[r].begin; i < packed.node_runs.run[r].end; ++i)
        EXPECT_EQ(slots.count(j * packed.stride + i), 1U) << i << ", " << j;
  }
}

TEST_P(BandsOfPatch, ComputeOrClearWhatAssemblingReads) {
  for (int j = 0; j < packed.rows; ++j) {
    const auto warp = with_gaps(slots_of(bands.warp, j), bands.warp_gaps, j);
    const auto here = with_gaps(slots_of(bands.between, j), bands.between_gaps, j);
    const auto below = j > 0 ? with_gaps(slots_of(bands.between, j - 1), bands.between_gaps, j - 1) : std::set<int>{};
    for (const int n : slots_of(bands.nodes, j)) {
      EXPECT_TRUE(warp.count(n) && warp.count(n - 1)) << n << " in row " << j;
      EXPECT_TRUE(here.count(n) && here.count(n - 1)) << n << " in row " << j;
      const bool has_below = below.count(n - packed.stride) == 1 && below.count(n - packed.stride - 1) == 1;
      EXPECT_TRUE(j == 0 || has_below) << n << " in row " << j;
    }
  }
}

TEST_P(BandsOfPatch, AreSharedOutWhole) {
  EXPECT_EQ(bands.first_row.front(), 0);
  EXPECT_EQ(bands.first_row.back(), packed.rows);
  for (const int threads : {1, 2, 3, 64}) {
    const auto share = balanced_bands(bands, threads);
    ASSERT_EQ(share.size(), static_cast<std::size_t>(threads + 1));
    EXPECT_EQ(share.front(), 0);
    EXPECT_EQ(share.back(), bands.size());
    EXPECT_TRUE(std::is_sorted(share.begin(), share.end()));
  }
}

}  // namespace
}  // namespace weaveform
