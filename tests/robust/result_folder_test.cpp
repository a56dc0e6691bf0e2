// A result folder holds one run: nothing stale stays in it, nothing of the user's is lost in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using weaveform::test::CommandResult;
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

// Whatever any command left of an older scene is gone or written anew after a run of another one, and a stranger's
// files are as they were, beside ours too.
TEST_F(ResultFolder, HoldsNothingOfAnOlderSceneWhateverWroteIt) {
  const fs::path source = WEAVEFORM_SOURCE_DIR;
  std::string drape = (source / "examples/drape_hemisphere.toml").string();
  drape += " --set blank.coarsening=6";
  const auto done = [&](const std::string& command) {
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  };
  done("weaveform drape " + drape + " --output drape --quiet");
  done(
      "weaveform run tiny.toml --output out --quiet --accuracy 90% --finest 0.25 --set analysis.duration=0.05 --set "
      "grip.top.travel=12 --set model.yarn_law=linear");
  done("weaveform post virtual out --quiet --set instrument.facet_size=4");
  done("weaveform post compare out out/virtual/stages --settings out/virtual/settings.toml --quiet");
  done("weaveform export tiny.toml --format gmsh --output mesh.msh --quiet");
  for (const char* name : {"drape.vtu", "drape.json", "flat_pattern.csv"})
    fs::copy_file(file("drape") / name, file("out") / name);
  write_text("solid punch (Written by weaveform import)\nendsolid punch\n", file("out/punch.stl"));
  write_text("killed", file("out/checkpoint.bin"));
  write_text("killed", file("out/checkpoint_clean.bin"));
  const std::vector<std::string> foreign = {"notes.txt",          "theirs.stl",       "frames/frame_0001_mine.vtu",
                                            "virtual/photo.png",  "frames/photo.png", "comparison/stages/stage_001.txt",
                                            "comparison/mine.md", "contours.vtp.bak"};
  for (const std::string& name : foreign) write_text("mine", file("out") / name);

  std::set<std::string> before;
  for (const auto& entry : fs::recursive_directory_iterator(file("out"))) {
    const std::string name = entry.path().lexically_relative(file("out")).string();
    if (entry.is_regular_file() && !name.starts_with("accuracy/") && entry.path().filename() != ".weaveform.lock")
      before.insert(name);
  }
  for (const std::string& name : before) fs::last_write_time(file("out") / name, fs::file_time_type::clock::now() - 1h);
  const auto long_ago = fs::file_time_type::clock::now() - 30min;
  done("weaveform run tiny.toml --output out --quiet --set output.frames=1");
  int ours = 0;
  for (const std::string& name : before) {
    const bool is_foreign = std::find(foreign.begin(), foreign.end(), name) != foreign.end();
    if (is_foreign) {
      EXPECT_EQ(read_text(file("out") / name), "mine") << name;
      continue;
    }
    ++ours;
    EXPECT_TRUE(!fs::exists(file("out") / name) || fs::last_write_time(file("out") / name) > long_ago) << name;
  }
  EXPECT_GT(ours, 25) << "too little was written for this to mean anything";
  EXPECT_FALSE(fs::exists(file("out/accuracy.md")));
  EXPECT_FALSE(fs::exists(file("out/punch.stl")));
}

// A tool that came with an imported mesh is an input of the folder's own scene.
TEST_F(ResultFolder, KeepsTheToolsThatItsOwnSceneNames) {
  write_text(
      "solid mine (Written by weaveform import)\nfacet normal 0 0 -1\nouter loop\nvertex -200 -200 50\nvertex 0 "
      "200 50\nvertex 200 -200 50\nendloop\nendfacet\nendsolid mine\n",
      file("plate.stl"));
  ASSERT_EQ(run("weaveform mesh tiny.toml --output out --quiet").exit_code, 0);
  fs::copy_file(file("plate.stl"), file("out/plate.stl"));
  write_text(tiny_scene() + "\n[tools.plate]\nshape = \"triangles\"\nfile = \"out/plate.stl\"\n", file("with.toml"));
  ASSERT_EQ(run("weaveform mesh with.toml --output out --quiet").exit_code, 0);
  EXPECT_TRUE(fs::exists(file("out/plate.stl")));
  ASSERT_EQ(run("weaveform run out/scene.toml --output out --quiet").exit_code, 0);
  EXPECT_TRUE(fs::exists(file("out/plate.stl")));
  ASSERT_EQ(run("weaveform mesh tiny.toml --output out --quiet").exit_code, 0);
  EXPECT_FALSE(fs::exists(file("out/plate.stl")));
}

// What is measured of a run under way, or of a killed one, is its history up to its last frame, a line cut short or
// not.
TEST_F(ResultFolder, OfAKilledRunIsReadByAllUpToItsLastFrame) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  std::string statistics = read_text(file("out/solve.json"));
  const auto at = statistics.find("\"finished\": true");
  ASSERT_NE(at, std::string::npos);
  write_text(statistics.replace(at, 16, "\"finished\": false"), file("out/solve.json"));
  std::string history = read_text(file("out/history.csv"));
  write_text(history.substr(0, history.size() - 7), file("out/history.csv"));
  for (const char* command : {"weaveform post out", "weaveform post virtual out --set instrument.facet_size=4",
                              "weaveform post border out", "weaveform export out --format csv --output fibres.csv"}) {
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  }
}

}  // namespace
