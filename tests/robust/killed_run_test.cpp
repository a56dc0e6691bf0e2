// A run that is killed, and cannot say a word, loses at most what came after its last checkpoint.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

// Runs into DIR, sends SIGNAL once FILE is there, and exits as the run does.
std::string stopped_by(const std::string& signal, const std::string& file, const std::string& how = "") {
  return how + " '" WEAVEFORM_BINARY "' run tiny.toml --output out --quiet &\nrun=$!\ntries=0\nwhile [ ! -e out/" +
         file + " ] && [ $tries -lt 15000 ]; do sleep 0.002; tries=$((tries + 1)); done\nkill -" + signal +
         " $run\nwait $run\n";
}

class KilledRun : public weaveform::test::CommandFolder {
protected:
  // A checkpoint about every hundred times what one costs. Runs take a tenth of a second and more on the fastest machine,
  // so that a signal meets them at work.
  void SetUp() override { write_scene("4"); }
  void write_scene(const std::string& duration) const {
    write_text(tiny_scene() + "checkpoint_minutes = 0.0001\n\n[analysis]\nduration = " + duration + "\n",
               file("tiny.toml"));
  }
  void expect_the_whole_run() const {
    ASSERT_EQ(run("weaveform run tiny.toml --output whole --quiet").exit_code, 0);
    EXPECT_EQ(read_text(file("out/history.csv")), read_text(file("whole/history.csv")));
    for (const std::string frame :
         {"frame_0000.vtu", "frame_0001.vtu", "frame_0002.vtu", "frame_0003.vtu", "frame_0004.vtu"})
      EXPECT_TRUE(read_text(file("out/frames") / frame) == read_text(file("whole/frames") / frame)) << frame;
    const auto summary = nlohmann::json::parse(read_text(file("out/summary.json")));
    EXPECT_EQ(summary.at("finished"), true);
    EXPECT_FALSE(fs::exists(file("out/checkpoint.bin")));
  }
};

TEST_F(KilledRun, GoesOnWithTheSameBits) {
  for (const std::string moment : {"frames/frame_0001.vtu", "frames/frame_0002.vtu", "frames/frame_0003.vtu"}) {
    fs::remove_all(file("out"));
    ASSERT_EQ(run(stopped_by("KILL", moment)).exit_code, 137);
    const auto resumed = run("weaveform run tiny.toml --output out --resume");
    ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  }
  expect_the_whole_run();
}

TEST_F(KilledRun, CanBeLookedAt) {
  ASSERT_EQ(run(stopped_by("KILL", "frames/frame_0002.vtu")).exit_code, 137);
  const auto post = run("weaveform post out");
  EXPECT_EQ(post.exit_code, 0) << post.err;
  EXPECT_NE(post.out.find("this run is not finished"), std::string::npos) << post.out;
  const auto summary = nlohmann::json::parse(read_text(file("out/summary.json")));
  EXPECT_EQ(summary.at("finished"), false);
  EXPECT_GT(summary.at("time_s"), 0.0);
  EXPECT_LT(summary.at("time_s"), 4.0);
  // a line that was being written when the machine stopped
  write_text(read_text(file("out/history.csv")) + "3.9,1.2", file("out/history.csv"));
  EXPECT_EQ(run("weaveform post out --quiet").exit_code, 0);
}

TEST_F(KilledRun, BeginsAgainWhereNoCheckpointWasWritten) {
  write_text(tiny_scene() + "checkpoint_minutes = 0\n\n[analysis]\nduration = 2\n", file("tiny.toml"));
  ASSERT_EQ(run(stopped_by("KILL", "frames/frame_0001.vtu")).exit_code, 137);
  const auto resumed = run("weaveform run tiny.toml --output out --resume");
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_NE(resumed.err.find("no checkpoint was written yet"), std::string::npos) << resumed.err;
  expect_the_whole_run();
  const auto again = run("weaveform run tiny.toml --output out --resume");
  EXPECT_EQ(again.exit_code, 0);
  EXPECT_NE(again.err.find("finished already"), std::string::npos) << again.err;
}

TEST_F(KilledRun, GoesOnOnlyAsItBegan) {
  ASSERT_EQ(run(stopped_by("TERM", "frames/frame_0001.vtu")).exit_code, 130);
  const auto other = run("weaveform run tiny.toml --output out --resume --set grip.top.travel=20");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("grip.top.travel: 30 in this run, 20 now"), std::string::npos) << other.err;
  EXPECT_EQ(run("weaveform run tiny.toml --output out --resume --quiet --set output.contour_step=7").exit_code, 0);
}

// The folder's own scene, changed behind the run's back.
TEST_F(KilledRun, RefusesAnotherSceneByNameInSolveToo) {
  ASSERT_EQ(run(stopped_by("INT", "frames/frame_0001.vtu")).exit_code, 130);
  ASSERT_EQ(run("sed -i 's/^travel = 30/travel = 29/' out/scene.toml").exit_code, 0);
  const auto other = run("weaveform solve out --resume");
  EXPECT_EQ(other.exit_code, 2) << other.err;
  EXPECT_NE(other.err.find("grip.top.travel: 30 in the checkpoint, 29 now"), std::string::npos) << other.err;
}

TEST_F(KilledRun, RefusesACardOfOtherContent) {
  const std::string card = read_text(fs::path(WEAVEFORM_SOURCE_DIR) / "fabric/cards/twintex-pw.toml");
  write_text(card, file("my.toml"));
  ASSERT_EQ(run("sed -i 's/\"twintex-pw\"/\"my.toml\"/' tiny.toml").exit_code, 0);
  ASSERT_EQ(run(stopped_by("INT", "frames/frame_0001.vtu")).exit_code, 130);
  ASSERT_EQ(run("sed -i 's/^thickness = 0.5/thickness = 0.6/' my.toml").exit_code, 0);
  ASSERT_NE(read_text(file("my.toml")), card);
  const auto other = run("weaveform solve out --resume");
  EXPECT_EQ(other.exit_code, 2) << other.err;
  EXPECT_NE(other.err.find(": content differs"), std::string::npos) << other.err;
}

class SignalledRun : public KilledRun, public testing::WithParamInterface<std::string> {};

TEST_P(SignalledRun, LeavesACheckpoint) {
  ASSERT_EQ(run(stopped_by(GetParam(), "frames/frame_0001.vtu")).exit_code, 130);
  EXPECT_TRUE(fs::exists(file("out/checkpoint.bin")));
}

INSTANTIATE_TEST_SUITE_P(Signals, SignalledRun,
                         testing::Values("INT", "TERM", "HUP", "QUIT", "XCPU", "USR1", "USR2", "ALRM", "PWR"),
                         [](const auto& one) { return one.param; });

TEST_F(KilledRun, GoesOnWithoutItsTerminalUnderNohup) {
  write_scene("2");
  const auto result = run("nohup " + stopped_by("HUP", "frames/frame_0001.vtu"));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(fs::exists(file("out/summary.json")));
}

TEST_F(KilledRun, ASecondSignalChangesNothing) {
  ASSERT_EQ(run("'" WEAVEFORM_BINARY "' run tiny.toml --output out --quiet &\nrun=$!\n"
                "while [ ! -e out/frames/frame_0001.vtu ]; do sleep 0.002; done\n"
                "for k in 1 2 3 4 5 6 7 8; do kill -TERM $run; kill -HUP $run; done 2>/dev/null\nwait $run\n")
                .exit_code,
            130);
  EXPECT_EQ(run("weaveform run tiny.toml --output out --resume --quiet").exit_code, 0);
  expect_the_whole_run();
}

TEST_F(KilledRun, LeavesNoHalfWrittenFileBehindInTheEnd) {
  ASSERT_EQ(run(stopped_by("KILL", "frames/frame_0001.vtu")).exit_code, 137);
  write_text("half", file("out/.checkpoint.bin.abcdefghijkl.partial"));
  write_text("half", file("out/frames/.frame_0002.vtu.abcdefghijkl.partial"));
  ASSERT_EQ(run("weaveform run tiny.toml --output out --resume --quiet").exit_code, 0);
  EXPECT_FALSE(fs::exists(file("out/.checkpoint.bin.abcdefghijkl.partial")));
  EXPECT_FALSE(fs::exists(file("out/frames/.frame_0002.vtu.abcdefghijkl.partial")));
}

}  // namespace
