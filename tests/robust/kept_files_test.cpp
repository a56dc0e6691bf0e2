// What Weaveform did not write is not lost: inputs, foreign folders, links, other runs' folders, files in the way of an
// export.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::read_text;
using weaveform::test::write_text;

class KeptFiles : public weaveform::test::CommandFolder {
protected:
  // `command` is refused with a line that has `words` in it (the name of `kept` when none are given), and `kept` stays
  // what it was.
  void expect_refused(const std::string& command, const std::string& kept, std::string words = "") const {
    if (words.empty()) words = fs::path(kept).filename().string();
    const std::string before = read_text(file(kept));
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, 2) << command << "\n" << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << result.err;
    EXPECT_EQ(read_text(file(kept)), before);
  }
  void write_outline_scene(const std::string& name) const {
    write_text("x,y\n-30,-30\n30,-30\n30,30\n-30,30\n-30,-30\n", file("outline.csv"));
    write_text(
        "[blank]\nshape = \"file\"\noutline = \"outline.csv\"\nyarn_angle = 0\ncoarsening = 4\n"
        "[tools.plate]\nshape = \"plane\"\n[analysis]\nduration = 0.001\n[output]\nhistory = 2\nframes = 1\n",
        file(name));
  }
};

TEST_F(KeptFiles, AnOutlineInTheFolderItIsRunInto) {
  write_outline_scene("outline.toml");
  for (const std::string command : {"run", "mesh"})
    expect_refused("weaveform " + command + " outline.toml --output .", "outline.csv");
  // also once the folder is ours, and by another name of the same file
  ASSERT_EQ(run("weaveform mesh outline.toml --output out --quiet").exit_code, 0);
  fs::create_hard_link(file("outline.csv"), file("out/outline.csv"));
  expect_refused("weaveform run outline.toml --output out", "out/outline.csv");
}

TEST_F(KeptFiles, InAFolderThatWeaveformNeverWrote) {
  fs::create_directories(file("theirs/frames"));
  for (const std::string name :
       {"history.csv", "mesh.vtu", "summary.json", "flat_pattern.csv", "frames/frame_0001.vtu"}) {
    write_text("mine", file("theirs/" + name));
    expect_refused("weaveform run tiny.toml --output theirs", "theirs/" + name);
    expect_refused("weaveform mesh tiny.toml --output theirs", "theirs/" + name);
    fs::remove(file("theirs/" + name));
  }
  write_text("mine", file("theirs/notes.txt"));
  ASSERT_EQ(run("weaveform run tiny.toml --output theirs --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform run tiny.toml --output theirs --quiet").exit_code, 0) << "it is ours now";
  EXPECT_EQ(read_text(file("theirs/notes.txt")), "mine");
}

TEST_F(KeptFiles, BehindALink) {
  fs::create_directories(file("victim"));
  write_text("mine", file("victim/frame_0000.vtu"));
  ASSERT_EQ(run("weaveform mesh tiny.toml --output out --quiet").exit_code, 0);
  fs::create_directory_symlink("../victim", file("out/frames"));
  expect_refused("weaveform run tiny.toml --output out", "victim/frame_0000.vtu", "out/frames: is a link");
  expect_refused("weaveform solve out", "victim/frame_0000.vtu", "out/frames: is a link");
  fs::remove(file("out/frames"));
  write_text("mine", file("victim/history.csv"));
  fs::create_symlink("../victim/history.csv", file("out/history.csv"));
  expect_refused("weaveform run tiny.toml --output out", "victim/history.csv");
}

TEST_F(KeptFiles, FramesThatAreNotOurs) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  for (const std::string name : {"frame_mine.vtu", "frame_12.vtu", "frame_0001_old.vtu"})
    write_text("mine", file("out/frames/" + name));
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet --set output.frames=1").exit_code, 0);
  for (const std::string name : {"frame_mine.vtu", "frame_12.vtu", "frame_0001_old.vtu"})
    EXPECT_EQ(read_text(file("out/frames/" + name)), "mine") << name;
  EXPECT_FALSE(fs::exists(file("out/frames/frame_0003.vtu")));
}

TEST_F(KeptFiles, TheFolderOfARunUnderWay) {
  const auto result =
      run("'" WEAVEFORM_BINARY
          "' run tiny.toml --output out --quiet --set analysis.duration=10 &\nfirst=$!\n"
          "while [ ! -e out/frames/frame_0000.vtu ]; do sleep 0.01; done\n"
          "for command in 'run tiny.toml --output out' 'mesh tiny.toml --output out' 'solve out' 'post out'; do\n"
          "  '" WEAVEFORM_BINARY
          "' $command --quiet; [ $? -eq 4 ] || echo \"$command was let in\"\ndone\n"
          "wait $first\n");
  EXPECT_EQ(result.exit_code, 0) << "the first is not disturbed: " << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("another run writes to this folder, process "), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("run tiny.toml"), std::string::npos) << result.err;
  ASSERT_EQ(run("weaveform run tiny.toml --output alone --quiet --set analysis.duration=10").exit_code, 0);
  EXPECT_EQ(read_text(file("out/history.csv")), read_text(file("alone/history.csv")));
  EXPECT_EQ(run("weaveform post out --quiet").exit_code, 0) << "the lock went with its holder";
}

TEST_F(KeptFiles, InTheWayOfAnExport) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  const std::string mesh = "weaveform export tiny.toml --quiet --format ",
                    formed = "weaveform export out --quiet --format ";
  for (const std::string& command :
       {mesh + "abaqus", mesh + "lsdyna", mesh + "openradioss", mesh + "gmsh", formed + "orientation-abaqus",
        formed + "drape-openradioss", formed + "csv", formed + "vtu"}) {
    write_text("mine\n", file("model"));
    expect_refused(command + " -o model", "model");
    EXPECT_EQ(run(command + " -o model --force").exit_code, 0) << command;
    EXPECT_NE(read_text(file("model")), "mine\n");
    EXPECT_EQ(run(command + " -o model").exit_code, 0) << "its own may be overwritten: " << command;
    fs::remove(file("model"));
  }
  expect_refused(formed + "vtu -o out/frames/frame_0004.vtu --force", "out/frames/frame_0004.vtu");
  expect_refused(mesh + "gmsh -o tiny.toml --force", "tiny.toml");
}

TEST_F(KeptFiles, InTheWayOfAChart) {
  write_text("x,y\n0,0\n1,1\n", file("table.csv"));
  write_text("mine", file("chart.svg"));
  expect_refused("weaveform chart table.csv -o chart.svg", "chart.svg");
  expect_refused("weaveform chart table.csv -o table.csv --force", "table.csv");
  ASSERT_EQ(run("weaveform chart table.csv -o chart.svg --force").exit_code, 0);
  EXPECT_EQ(run("weaveform chart table.csv -o chart.svg").exit_code, 0);
  ASSERT_EQ(run("weaveform chart table.csv -o page.html").exit_code, 0);
  EXPECT_EQ(run("weaveform chart table.csv -o page.html").exit_code, 0);
}

TEST_F(KeptFiles, InTheWayOfATool) {
  write_text(
      "solid p\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\nendloop\nendfacet\n"
      "endsolid p\n",
      file("punch.stl"));
  write_text("mine", file("other.stl"));
  expect_refused("weaveform tool punch.stl -o other.stl", "other.stl");
  expect_refused("weaveform tool punch.stl -o ./punch.stl --force", "punch.stl");
  ASSERT_EQ(run("weaveform tool punch.stl -o other.stl --force").exit_code, 0);
  EXPECT_EQ(run("weaveform tool punch.stl -o other.stl").exit_code, 0);
  write_text("SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 10, 10, 10};\n", file("box.geo"));
  ASSERT_EQ(run("weaveform tool box.geo -o box.step").exit_code, 0);
  EXPECT_EQ(run("weaveform tool box.geo -o box.step").exit_code, 0) << "ours to write anew";
  EXPECT_EQ(run("weaveform tool box.step").exit_code, 0);
}

TEST_F(KeptFiles, InTheWayOfAUnitCell) {
  fs::create_directories(file("cell"));
  write_text("mine", file("cell/unit_cell.csv"));
  const std::string command = "weaveform unit-cell --increments 10 --quiet --output cell";
  expect_refused(command, "cell/unit_cell.csv");
  ASSERT_EQ(run(command + " --force").exit_code, 0);
  EXPECT_EQ(run(command).exit_code, 0);
}

TEST_F(KeptFiles, InTheWayOfAVirtualMeasurement) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  fs::create_directories(file("theirs/stages"));
  write_text("mine", file("theirs/stages/stage_001.txt"));
  expect_refused("weaveform post virtual out --set instrument.facet_size=4 --output theirs",
                 "theirs/stages/stage_001.txt");
  ASSERT_EQ(run("weaveform post virtual out --set instrument.facet_size=4 --quiet").exit_code, 0);
  EXPECT_EQ(run("weaveform post virtual out --set instrument.facet_size=4 --quiet").exit_code, 0);
}

TEST_F(KeptFiles, AStudysInputsAndForeignTables) {
  write_text("scene = \"tiny.toml\"\nmeasures = [\"steps\"]\n[grid]\n\"blank.coarsening\" = [4]\n", file("plan.toml"));
  fs::create_directories(file("theirs"));
  write_text("mine", file("theirs/study.csv"));
  expect_refused("weaveform study plan.toml --output theirs", "theirs/study.csv");
  EXPECT_EQ(run("weaveform study plan.toml --output theirs --force --quiet").exit_code, 0);
  EXPECT_NE(read_text(file("theirs/study.csv")), "mine");
  EXPECT_EQ(read_text(file("plan.toml")).substr(0, 5), "scene");
}

TEST_F(KeptFiles, BesideTheStagesOfAVirtualMeasurement) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  for (const char* stages : {"3", "2"}) {
    ASSERT_EQ(
        run(std::string("weaveform post virtual out --quiet --set instrument.facet_size=4 --set virtual.stages=") +
            stages)
            .exit_code,
        0);
    write_text("mine", file("out/virtual/stages/stage_mine.txt"));
  }
  EXPECT_FALSE(fs::exists(file("out/virtual/stages/stage_003.txt")));
  EXPECT_EQ(read_text(file("out/virtual/stages/stage_mine.txt")), "mine");
}

TEST_F(KeptFiles, TheFoldersOwnSceneAsLongAsItStaysTheSame) {
  ASSERT_EQ(run("weaveform run tiny.toml --output out --quiet").exit_code, 0);
  EXPECT_EQ(run("weaveform run out/scene.toml --output out --quiet").exit_code, 0);
  expect_refused("weaveform run out/scene.toml --output out --set grip.top.travel=20", "out/scene.toml");
}

}  // namespace
