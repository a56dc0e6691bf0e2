// A result folder holds one run: nothing stale stays in it, nothing of the user's is lost in it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

class ResultFolder : public weaveform::test::CommandFolder {
protected:
  [[nodiscard]] std::ptrdiff_t frames() const {
    const fs::directory_iterator entries(file("out/frames"));
    return std::distance(fs::begin(entries), fs::end(entries));
  }
};

TEST_F(ResultFolder, HoldsNoFrameOfAnOlderRun) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  EXPECT_EQ(frames(), 5) << "the initial frame and output.frames = 4";
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet --set output.frames=2").exit_code, 0);
  EXPECT_EQ(frames(), 3);
}

TEST_F(ResultFolder, MeshAloneTakesTheOldAnswersAway) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform mesh tiny.toml --output out --quiet").exit_code, 0);
  for (const std::string name : {"summary.json", "history.csv", "result.pvd", "contours.vtp", "solve.json"})
    EXPECT_FALSE(fs::exists(file("out") / name)) << name;
}

TEST_F(ResultFolder, LeavesForeignFilesAlone) {
  fs::create_directories(file("out/frames"));
  write_text("mine", file("out/notes.txt"));
  write_text("mine", file("out/frames/photo.png"));
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("out/notes.txt")), "mine");
  EXPECT_EQ(read_text(file("out/frames/photo.png")), "mine");
}

TEST_F(ResultFolder, NeverOverwritesASceneOfTheUser) {
  write_text(tiny_scene(), file("scene.toml"));
  const auto result = run("weaveform run scene.toml --output .");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(read_text(file("scene.toml")), tiny_scene());
}

TEST_F(ResultFolder, HoldsASceneThatRunsAgainToTheSameHistory) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform run out/scene.toml --output again --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("out/history.csv")), read_text(file("again/history.csv")));
}

TEST_F(ResultFolder, IsNamedAfterTheSceneByDefault) {
  ASSERT_EQ(run("weaveform mesh tiny.toml --quiet").exit_code, 0);
  EXPECT_TRUE(fs::exists(file("results/tiny/mesh.vtu")));
}

}  // namespace
