#include "solver/state/team.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace weaveform {
namespace {

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

TEST(Team, DoesEveryBlockOnceInEveryRound) {
  for (const int threads : {1, 2, 3, 7}) {
    Team team(threads);
    for (const int blocks : {0, 1, 2, 5, 64}) {
      std::vector<int> times(blocks, 0);  // a block writes its own entry only, as the solver's do
      constexpr int rounds = 500;
      for (int round = 0; round < rounds; ++round) team.run(blocks, [&](int block) { ++times[block]; });
      EXPECT_EQ(times, std::vector<int>(blocks, rounds)) << threads << " threads, " << blocks << " blocks";
    }
  }
}

// A thread that comes late to a short loop finds the next, longer one under way.
TEST(Team, LoopsOfDifferentLengthsEndWithEachBlockDoneOnce) {
  Team team(12);  // more than there are cores, so that some come late
  const std::vector<int> lengths = {2, 9, 3, 40, 5};
  std::vector<std::atomic<int>> times(40);
  for (int round = 0; round < 20000; ++round) {
    const int blocks = lengths[static_cast<std::size_t>(round) % lengths.size()];
    team.run(blocks, [&](int block) { ++times[block]; });
    for (int block = 0; block < blocks; ++block) ASSERT_EQ(times[block].exchange(0), 1) << block << " of " << blocks;
    for (int block = blocks; block < 40; ++block) ASSERT_EQ(times[block], 0) << block << " beyond " << blocks;
  }
}

TEST(Team, IsDoneWhenItReturns) {
  Team team(3);
  std::vector<double> value(30, 0.0);
  for (int round = 1; round <= 2000; ++round) {
    team.run(30, [&](int block) { value[block] = round + block; });
    double sum = 0.0;
    for (const double v : value) sum += v;
    ASSERT_EQ(sum, 30.0 * round + 435.0);
  }
}

TEST(Team, ThrowsWhatTheLowestBlockThrewAndGoesOn) {
  Team team(4);
  for (int round = 0; round < 50; ++round) {
    std::atomic<int> done = 0;
    try {
      team.run(16, [&](int block) {
        ++done;
        if (block % 5 == 3) throw std::runtime_error("block " + std::to_string(block));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "block 3");
    }
    EXPECT_EQ(done, 16);
  }
}

// With OpenMP's barriers this took as much time of the processor as of the clock, from each thread.
TEST(Team, SleepsWhileItHasNothingToDo) {
  Team team(4);
  team.run(4, [](int) {});
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const double before = cpu_seconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_LT(cpu_seconds() - before, 0.1);
}

// Sixteen threads on few cores: most of the team never gets to run while a round lasts.
TEST(Team, IsNotHeldUpByThreadsThatDoNotGetToRun) {
  const auto seconds = [](int threads) {
    Team team(threads);
    std::vector<double> value(16, 0.0);
    const auto begin = std::chrono::steady_clock::now();
    for (int round = 0; round < 3000; ++round)
      team.run(16, [&](int block) {
        for (int k = 0; k < 500; ++k) value[block] = 0.5 * value[block] + k;
      });
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  EXPECT_LT(seconds(16), 20.0 * seconds(1) + 1.0);
}

}  // namespace
}  // namespace weaveform
