// Nothing is begun that would not end, or that the machine cannot hold: it is said at once, with the numbers and the
// likely cause. Each command must come back in a small part of the time it would otherwise take.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::CommandResult;
using weaveform::test::run_command;
using weaveform::test::TemporaryFolder;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

#if defined(__SANITIZE_ADDRESS__)  // takes terabytes of address space for itself
constexpr const char* bounds = "timeout 500 ";
#else
constexpr const char* bounds = "ulimit -v 2000000; timeout 20 ";
#endif

class WithoutEnd : public testing::Test {
protected:
  void SetUp() override { write_text(tiny_scene(), folder_.path() / "tiny.toml"); }
  // With a bound on memory that no honest answer needs, and one on time.
  [[nodiscard]] CommandResult run(const std::string& command) const {
    return run_command(bounds + (WEAVEFORM_BINARY " " + command), folder_.path());
  }
  void expect_refused(const std::string& command, const std::string& words) const {
    const auto result = run(command);
    EXPECT_EQ(result.exit_code, 2) << command << ": " << result.err;
    EXPECT_NE(result.err.find(words), std::string::npos) << command << ": " << result.err;
    for (const char* no_number : {"inf", "nan", "e+30"})
      EXPECT_EQ(result.err.find(no_number), std::string::npos) << command << ": " << result.err;
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_.path() / name; }

private:
  TemporaryFolder folder_;
};

TEST_F(WithoutEnd, ARunBeyondItsHoursSaysSoWithTheCause) {
  for (const std::string command : {"run tiny.toml -o out", "check tiny.toml"}) {
    expect_refused(command + " --set analysis.duration=1e9", "analysis.duration");
    expect_refused(command + " --set analysis.mass_scale=1e-14", "analysis.mass_scale");
    expect_refused(command + " --set analysis.step_factor=1e-9", "analysis.step_factor");
    expect_refused(command + " --set analysis.loading_speed=1e-6", "analysis.loading_speed");
  }
  EXPECT_FALSE(fs::exists(file("out"))) << "refused, it leaves nothing behind";
}

TEST_F(WithoutEnd, HoursCanBeAllowed) {
  const std::string short_day = " --set analysis.most_hours=1e-9";
  expect_refused("run tiny.toml -o out" + short_day, "most_hours");
  EXPECT_EQ(run("run tiny.toml -o out -q --yes" + short_day).exit_code, 0);
  EXPECT_EQ(run("check tiny.toml --set analysis.duration=1e9 --set analysis.most_hours=1e5 --yes").exit_code, 0);
}

TEST_F(WithoutEnd, ASolveOfAFolderIsHeldToTheSameBounds) {
  ASSERT_EQ(run("mesh tiny.toml -o out -q --set analysis.duration=1e9").exit_code, 0);
  expect_refused("solve out", "analysis.duration");
}

TEST_F(WithoutEnd, AMeshBeyondTheMemoryIsNeverBegun) {
  write_text(
      "name = \"fine\"\nthickness = 0.5\n[yarn]\nlinear_density = 1870\nsection = 1.25\ninterval = 0.001\n"
      "tension = [{ from = 0.0, coefficients = [19800] }]\n[shear]\ntangent = [{ from = 0.0, coefficients = [0.2] }]\n",
      file("fine.toml"));
  for (const std::string command : {"run tiny.toml -o out", "check tiny.toml", "mesh tiny.toml -o out",
                                    "export tiny.toml --format abaqus -o out.inp"}) {
    expect_refused(command + " --set blank.size=[1e5,1e5] --set blank.coarsening=1", "raise blank.coarsening");
    expect_refused(command + " --set fabric.material=./fine.toml", "a yarn every 0.004");
    expect_refused(command + " --set blank.size=[20000,20000] --set blank.coarsening=1", "of memory");
  }
  EXPECT_EQ(run("mesh tiny.toml --plan --set blank.size=[1e5,1e5] --set blank.coarsening=0.1").exit_code, 2);
  EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(WithoutEnd, TheOutlyingPointOfAnOutlineIsNamed) {
  write_text("0,0\n100,0\n100,100\n50,1000000\n0,100\n0,0\n", file("slip.csv"));
  write_text("[blank]\nshape = \"file\"\noutline = \"slip.csv\"\n[[grip]]\nname = \"a\"\nbox = [-1, -1, 101, 5]\n",
             file("slip.toml"));
  for (const std::string command : {"run slip.toml -o out", "check slip.toml", "mesh slip.toml -o out"})
    expect_refused(command, "slip.csv:4 (50, 1e+06) lies far from all others");
}

TEST_F(WithoutEnd, MoreFramesThanTheDiskHoldsAreRefused) {
  // 10,000 frames of 1e5 cells are 200 GB; where the disk has that, there is nothing to refuse
  const auto result =
      run("check tiny.toml --set output.frames=10000 --set blank.size=[115,230] --set blank.coarsening=0.1 "
          "--set analysis.most_hours=1e5");
  const bool room = fs::space(file(".")).available > 400'000'000'000U;
  EXPECT_EQ(result.exit_code, room ? 0 : 2) << result.err;
}

// The other side: what takes minutes or an hour is nobody's business.
TEST_F(WithoutEnd, LargeHonestScenesPass) {
  for (const std::string setting :
       {"--set blank.coarsening=0.2", "--set analysis.duration=1", "--set model.cell=shell --set blank.coarsening=1",
        "--set output.frames=200", "--set output.history=100000"}) {
    const auto result = run("check tiny.toml " + setting);
    EXPECT_EQ(result.exit_code, 0) << setting << ": " << result.err;
  }
}

TEST_F(WithoutEnd, OnlyRegularFilesAreRead) {
  ASSERT_EQ(run_command("mkfifo pipe.toml pipe.csv pipe.stl && truncate -s 10G huge.toml && mkdir dir.toml", file("."))
                .exit_code,
            0);
  for (const std::string name : {"pipe.toml", "/dev/zero", "dir.toml", "huge.toml"}) {
    for (const std::string command : {"run ", "check ", "mesh ", "fit ", "study ", "drape "}) {
      const auto result = run(command + name);
      EXPECT_EQ(result.exit_code, 4) << command << name << ": " << result.err;
      EXPECT_NE(result.err.find(name), std::string::npos) << result.err;
    }
    EXPECT_EQ(
        run("check tiny.toml --set fabric.material=" + std::string(name.front() == '/' ? "" : "./") + name).exit_code,
        4)
        << name;
  }
  EXPECT_EQ(run("check tiny.toml --set blank.shape=file --set blank.outline=pipe.csv").exit_code, 4);
  EXPECT_EQ(run("tool pipe.stl").exit_code, 4);
  EXPECT_EQ(run("chart pipe.csv -o chart.svg").exit_code, 4);
  EXPECT_EQ(run("import pipe.csv -o imported").exit_code, 2) << "its ending is none of a mesh";
}

}  // namespace
