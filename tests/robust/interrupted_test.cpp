// A run that is stopped can go on, and then ends with the same bits as one that never stopped.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/instrumented.hpp"
#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::CommandResult;
using weaveform::test::instrumented;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

// Starts a run, interrupts it as soon as its second frame is there (so it is surely under way), and exits as it does.
constexpr const char* interrupted_run = R"(
"$BINARY" run tiny.toml --output stopped --quiet &
run=$!
tries=0
while [ ! -e stopped/frames/frame_0001.vtu ] && [ $tries -lt 3000 ]; do sleep 0.01; tries=$((tries + 1)); done
kill -INT $run
wait $run
)";

class InterruptedRun : public testing::Test {
protected:
  explicit InterruptedRun(std::string duration = instrumented ? "0.3" : "1.5", std::string analysis = "")
      : duration_(std::move(duration)), analysis_(std::move(analysis)) {}
  void SetUp() override {
    // Long enough (a slow pull, many frames) that the interruption comes well before the end.
    write_text(tiny_scene() + "\n[analysis]\nduration = " + duration_ + "\n" + analysis_, file("tiny.toml"));
  }
  [[nodiscard]] CommandResult run(const std::string& command) const {
    return run_command("BINARY='" WEAVEFORM_BINARY "'\n" + command, folder_.path());
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_.path() / name; }

private:
  std::string duration_, analysis_;  // s; further keys
  TemporaryFolder folder_;
};

TEST_F(InterruptedRun, LeavesACheckpointAndGoesOnToTheSameBits) {
  const auto stopped = run(interrupted_run);
  ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
  ASSERT_TRUE(fs::exists(file("stopped/checkpoint.bin")));
  EXPECT_FALSE(fs::exists(file("stopped/summary.json"))) << "an interrupted run must not look finished";

  ASSERT_EQ(run("weaveform run tiny.toml --output stopped --resume --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform run tiny.toml --output whole --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("stopped/history.csv")), read_text(file("whole/history.csv")));
  // Not EXPECT_EQ, which would print the binary content.
  EXPECT_TRUE(read_text(file("stopped/frames/frame_0004.vtu")) == read_text(file("whole/frames/frame_0004.vtu")));
}

// Ten times as slow, for it takes a tenth of the steps.
class InterruptedReachingRun : public InterruptedRun {
protected:
  InterruptedReachingRun() : InterruptedRun(instrumented ? "3" : "15", "step_bound = \"reached\"\n") {}
};

TEST_F(InterruptedReachingRun, GoesOnWithTheStrainsThatItHadReached) {
  const auto stopped = run(interrupted_run);
  ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
  ASSERT_EQ(run("weaveform run tiny.toml --output stopped --resume --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform run tiny.toml --output whole --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("stopped/history.csv")), read_text(file("whole/history.csv")));
}

TEST_F(InterruptedRun, DoesNotGoOnWithAnotherScene) {
  ASSERT_EQ(run(interrupted_run).exit_code, 130);
  const auto resumed = run("weaveform run tiny.toml --output stopped --resume --set grip.top.travel=20");
  EXPECT_EQ(resumed.exit_code, 2) << resumed.err;
  EXPECT_TRUE(fs::exists(file("stopped/checkpoint.bin"))) << "the checkpoint is still worth having";
}

TEST(ResumeWithoutACheckpoint, StartsFromTheBeginningAndSaysSo) {
  const TemporaryFolder folder;
  write_text(tiny_scene(), folder.path() / "tiny.toml");
  ASSERT_EQ(run_command("weaveform mesh tiny.toml --output out --quiet", folder.path()).exit_code, 0);
  const auto result = run_command("weaveform solve out --resume", folder.path());
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("no checkpoint was written yet"), std::string::npos) << result.err;
}

}  // namespace
