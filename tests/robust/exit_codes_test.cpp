// The exit codes of the program and what it says with them (README.md, "Exit codes").
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "tests/support/command_folder.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::says;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

class ExitCodes : public weaveform::test::CommandFolder {};

TEST_F(ExitCodes, HelpAndVersionAreNoErrors) {
  EXPECT_EQ(run("weaveform --help").exit_code, 0);
  EXPECT_EQ(run("weaveform run --help").exit_code, 0);
  const auto version = run("weaveform --version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("weaveform ")) << version.out;
  EXPECT_TRUE(says(version.out, "commit")) << version.out;
}

TEST_F(ExitCodes, WrongUsageIsWrongInput) {
  for (const std::string command :
       {"weaveform", "weaveform nonsense", "weaveform run", "weaveform run tiny.toml --nonsense",
        "weaveform run tiny.toml --threads many", "weaveform run tiny.toml --threads -1"}) {
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, 2) << command;
    EXPECT_TRUE(result.err.starts_with("error: ")) << command << ": " << result.err;
    EXPECT_EQ(result.out, "") << command;
  }
}

TEST_F(ExitCodes, MisspeltKeyIsShownWithItsPlaceAndTheNearestName) {
  write_text("[blank]\nsise = [115.0, 230.0]\n", file("wrong.toml"));
  const auto result = run("weaveform check wrong.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "wrong.toml:2:1")) << result.err;
  EXPECT_TRUE(says(result.err, "size")) << result.err;
}

TEST_F(ExitCodes, AllComplaintsComeAtOnceEachOnItsLine) {
  write_text(tiny_scene() + "colour = 1\n\n[analysis]\nstep_factor = \"fast\"\n\n[model]\nyarn = \"rope\"\n",
             file("wrong.toml"));
  const auto result = run("weaveform run wrong.toml --output out");
  EXPECT_EQ(result.exit_code, 2);
  for (const std::string word : {"colour", "step_factor", "rope"})
    EXPECT_TRUE(says(result.err, word)) << word << result.err;
  EXPECT_FALSE(fs::exists(file("out"))) << "a wrong scene must leave nothing behind";
}

TEST_F(ExitCodes, WrongOverrideNamesItsKey) {
  const auto result = run("weaveform check tiny.toml --set blank.sise=3");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "--set blank.sise")) << result.err;
}

TEST_F(ExitCodes, OverridesMayStandBeforeTheScene) {
  const auto result = run("weaveform check --set grip.top.travel=7.5 --set 'blank.size=[115,240]' tiny.toml");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(says(result.out, "travel = 7.5")) << result.out;
}

TEST_F(ExitCodes, CheckedSceneReadsBackTheSame) {
  const auto first =
      run("weaveform check tiny.toml > complete.toml && weaveform check complete.toml > again.toml && "
          "cmp complete.toml again.toml");
  EXPECT_EQ(first.exit_code, 0) << first.out << first.err;
}

TEST_F(ExitCodes, MissingFilesAreFileTrouble) {
  EXPECT_EQ(run("weaveform run absent.toml").exit_code, 4);
  EXPECT_EQ(run("weaveform solve absent").exit_code, 4);
  EXPECT_EQ(run("weaveform post absent").exit_code, 4);
}

TEST_F(ExitCodes, UnwritableOutputIsFileTrouble) {
  write_text("", file("in_the_way"));
  for (const std::string output : {"in_the_way", "in_the_way/below"}) {
    const auto result = run("weaveform mesh tiny.toml --output " + output);
    EXPECT_EQ(result.exit_code, 4) << output << ": " << result.err;
    EXPECT_TRUE(says(result.err, "in_the_way")) << result.err;
  }
}

TEST_F(ExitCodes, FullStandardOutputIsFileTrouble) {
  EXPECT_EQ(run("weaveform check tiny.toml > /dev/full").exit_code, 4);
}

// A file-size limit of 0 lets nothing be written, as a full disk does. The signal that comes with it is ignored, so
// that the program meets the failed write itself.
bool holds_only_the_lock(const fs::path& folder) {
  return std::all_of(fs::directory_iterator(folder), fs::directory_iterator(),
                     [](const auto& entry) { return entry.path().filename() == ".weaveform.lock"; });
}

TEST_F(ExitCodes, FullDiskIsFileTroubleAndLeavesNoHalfFile) {
  const auto result =
      run("trap '' XFSZ; ( ulimit -f 0; '" WEAVEFORM_BINARY "' mesh tiny.toml --output out ) >/dev/null 2>&1");
  EXPECT_EQ(result.exit_code, 4);
  EXPECT_TRUE(holds_only_the_lock(file("out"))) << "a file that could not be written whole was left behind";
}

// Four times the stable step of yarns that are stiff from the start, unchecked: central differences must blow up.
TEST_F(ExitCodes, UnstableStepIsFailedPhysics) {
  const auto result =
      run("weaveform run tiny.toml --output out --quiet --set model.yarn_law=linear --set analysis.step_factor=4 "
          "--set analysis.step_check=false");
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_TRUE(result.err.starts_with("error: ")) << result.err;
  EXPECT_FALSE(fs::exists(file("out/summary.json"))) << "a failed run must not look finished";
}

TEST_F(ExitCodes, QuietRunPrintsNothing) {
  // beams: a specimen of so few cells warns of its zones' borders with trusses
  const auto result = run("weaveform run tiny.toml --output out --quiet --set model.yarn=beam");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out + result.err, "");
}

// Charts are drawn in node, which may be missing.
TEST_F(ExitCodes, WithoutNodeAChartIsFileTroubleAndANumberIsNot) {
  write_text("x,y\n1,2\n2,3\n", file("table.csv"));
  const std::string chart = "weaveform chart table.csv --output chart.svg";
  ASSERT_EQ(run(chart).exit_code, 0);
  const auto failed = run("PATH=/nowhere; " + chart);
  EXPECT_EQ(failed.exit_code, 4) << failed.err;
  EXPECT_TRUE(says(failed.err, "nodejs")) << failed.err;
  EXPECT_FALSE(fs::exists(file("chart.svg"))) << "the older chart passes for a new one";

  ASSERT_EQ(run("weaveform chart table.csv --output chart.html").exit_code, 0);
  EXPECT_TRUE(weaveform::test::read_text(file("chart.html")).starts_with("<!DOCTYPE html>"));

  const std::string numbers = "weaveform unit-cell --increments 70 --output cell --quiet";
  ASSERT_EQ(run(numbers).err, "");
  fs::remove(file("cell/unit_cell.csv"));
  const auto done = run("PATH=/nowhere; " + numbers);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(done.err.starts_with("warning: ")) << done.err;
  EXPECT_EQ(done.err.find('\n') + 1, done.err.size()) << "said once for two charts";
  EXPECT_TRUE(fs::exists(file("cell/unit_cell.csv")));
  EXPECT_FALSE(fs::exists(file("cell/unit_cell.svg")) || fs::exists(file("cell/unit_cell_error.svg")));
}

TEST_F(ExitCodes, AVerboseLogNamesProgramAndEveryValue) {
  const auto result = run("weaveform mesh tiny.toml --output out --verbose");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.err.starts_with("weaveform ")) << result.err;
  EXPECT_TRUE(says(result.err, "step_factor")) << "defaults belong to the log";
}

}  // namespace
