// 100,000 points in 50 stages are compared in seconds and in the memory of a single stage.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>
#include <filesystem>

#include "post/dic/comparison/compare.hpp"
#include "tests/support/run_command.hpp"

namespace {

using namespace weaveform;

TEST(DicThroughput, HundredThousandPointsInFiftyStages) {
  const test::TemporaryFolder folder;
  test::write_text(test::tiny_scene(), folder.path() / "scene.toml");
  const auto run = [&](const std::string& command) {
    const auto told = test::run_command(command, folder.path());
    ASSERT_EQ(told.exit_code, 0) << told.err;
  };
  run("weaveform run scene.toml -o pw -q --set output.frames=50");
  run("weaveform post virtual pw -o lab -q --set instrument.facet_size=1 --set instrument.step=0.5 --set "
      "virtual.noise=0.002");
  const auto settings =
      dic::read_settings((folder.path() / "lab" / "settings.toml").string(), {"comparison.fields=none"});
  const auto start = std::chrono::steady_clock::now();
  const auto compared = dic::compare(folder.path() / "pw", {(folder.path() / "lab" / "stages").string()}, settings,
                                     folder.path() / "out");
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(compared.stage.size(), 50U);
  EXPECT_GE(compared.stage.back().points, 100000);
  for (const auto& stage : compared.stage) EXPECT_TRUE(stage.verdict.agrees) << stage.label << stage.verdict.words;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  RecordProperty("wall_s", std::to_string(wall.count()));
  RecordProperty("peak_kB", std::to_string(usage.ru_maxrss));
  // Measured: 7.8 s and 103 MB on one core of a busy machine; four times the time, and what two stages would need.
  EXPECT_LT(wall.count(), 32.0);
  EXPECT_LT(usage.ru_maxrss, 250000);
}

}  // namespace
