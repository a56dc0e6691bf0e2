// Studies of many runs: stopped and resumed, with cases that fail or crash, through Snakemake, and runs to an accuracy.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/instrumented.hpp"
#include "tests/support/run_command.hpp"

namespace {

namespace fs = std::filesystem;
using weaveform::test::CommandResult;
using weaveform::test::instrumented;
using weaveform::test::read_text;
using weaveform::test::run_command;
using weaveform::test::says;
using weaveform::test::TemporaryFolder;
using weaveform::test::tiny_scene;
using weaveform::test::write_text;

class StudyRun : public testing::Test {
protected:
  void SetUp() override { write_text(tiny_scene() + "\n[analysis]\nduration = 0.1\n", file("tiny.toml")); }
  [[nodiscard]] CommandResult run(const std::string& command) const {
    return run_command("BINARY='" WEAVEFORM_BINARY "'\n" + command, folder_.path());
  }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_.path() / name; }
  void write_study(const std::string& text) const {
    write_text("scene = \"tiny.toml\"\nmeasures = [\"grips.top.force_N\", \"max(kinetic_energy_mJ)\"]\n" + text,
               file("s.toml"));
  }
  [[nodiscard]] fs::path case_file(const std::string& study, const std::string& ending) const {
    for (const auto& entry : fs::directory_iterator(file(study) / "cases"))
      if (entry.path().extension() == ending) return entry.path();
    return {};
  }

private:
  TemporaryFolder folder_;
};

// Two short cases, then two long ones (a second each).
constexpr const char* short_and_long = "[grid]\nanalysis.duration = [0.05, 0.06, 0.8, 0.9]\n";

// Starts the study and sends it `signal` as soon as a case has ended, so that others are under way.
std::string stopped_study(const std::string& signal) {
  return "\"$BINARY\" study s.toml --output out --jobs 2 --quiet &\nrun=$!\ntries=0\n"
         "while ! ls out/cases/*.exit >/dev/null 2>&1 && [ $tries -lt 3000 ]; do sleep 0.01; tries=$((tries + 1)); "
         "done\n"
         "kill -" +
         signal + " $run\nwait $run\n";
}

TEST_F(StudyRun, KilledAndResumedGivesTheSameTable) {
  write_study(short_and_long);
  ASSERT_EQ(run(stopped_study("KILL")).exit_code, 137);
  EXPECT_FALSE(fs::exists(file("out/study.csv")));
  const fs::path finished = case_file("out", ".exit");
  const auto when = fs::last_write_time(finished);

  ASSERT_EQ(run("weaveform study s.toml --output out --quiet").exit_code, 0);
  EXPECT_EQ(fs::last_write_time(finished), when) << "a finished case is not run again";
  ASSERT_EQ(run("weaveform study s.toml --output whole --jobs 1 --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("out/study.csv")), read_text(file("whole/study.csv")));
}

TEST_F(StudyRun, InterruptedLeavesCheckpointsAndResumes) {
  write_study("[grid]\nanalysis.duration = [0.05, 0.8, 0.9]\n");
  // One at a time: when a second case has a frame, the first has ended and the second is surely under way.
  const auto stopped = run(R"("$BINARY" study s.toml --output out --jobs 1 --quiet &
run=$!
tries=0
frames() { ls out/cases/*/frames/frame_0001.vtu 2>/dev/null | wc -l; }
while [ $(frames) -lt 2 ] && [ $tries -lt 3000 ]; do sleep 0.01; tries=$((tries + 1)); done
kill -TERM $run
wait $run
)");
  ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
  EXPECT_EQ(run("ls out/cases/*/checkpoint.bin").exit_code, 0) << "a case under way goes on from where it was";
  const auto partly = run("weaveform study s.toml --output out --collect --quiet");
  EXPECT_EQ(partly.exit_code, 0) << partly.err;
  EXPECT_TRUE(says(read_text(file("out/study.csv")), "not run"));
  ASSERT_EQ(run("weaveform study s.toml --output out --quiet").exit_code, 0);
  ASSERT_EQ(run("weaveform study s.toml --output whole --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("out/study.csv")), read_text(file("whole/study.csv")));
}

TEST_F(StudyRun, FailingCasesAreRecordedAndTheOthersFinish) {
  write_study(
      "[[case]]\n[[case]]\nblank.coarsening = 30\n[[case]]\nmodel.yarn_law = \"linear\"\n"
      "analysis.step_factor = 4\nanalysis.step_check = false\n"
      "[[case]]\nblank.coarsening = 3\n");
  const auto result = run("weaveform study s.toml --output out --jobs 2");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(says(result.err, "2 done, 2 failed, 0 not run")) << result.err;
  const std::string table = read_text(file("out/study.csv"));
  EXPECT_TRUE(says(table, ",30,,,,2,")) << table;
  EXPECT_TRUE(says(table, ".toml: blank.coarsening: ")) << "the error line: " << table;
  EXPECT_TRUE(says(table, ",linear,4,false,3,")) << table;
  const auto again = run("weaveform study s.toml --output out");
  EXPECT_TRUE(says(again.err, "every case has been run before")) << again.err;
  EXPECT_EQ(read_text(file("out/study.csv")), table);
}

TEST_F(StudyRun, ACrashOfOneCaseLeavesTheOthersAlone) {
  write_study("[grid]\nanalysis.duration = [3, 0.05]\n");
  const auto result = run(R"("$BINARY" study s.toml --output out --jobs 2 --quiet &
run=$!
tries=0
while ! ls out/cases/*.exit >/dev/null 2>&1 && [ $tries -lt 3000 ]; do sleep 0.01; tries=$((tries + 1)); done
kill -SEGV $(cat /proc/$run/task/$run/children)
wait $run
)");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string table = read_text(file("out/study.csv"));
#if defined(__SANITIZE_ADDRESS__)  // which answers the signal itself
  EXPECT_TRUE(says(table, ",3,1,")) << table;
#else
  EXPECT_TRUE(says(table, ",3,139,killed by signal 11")) << table;
#endif
  EXPECT_TRUE(says(table, ",0.05,0,,")) << table;
}

TEST_F(StudyRun, TwoStudiesDoNotWriteIntoOneFolder) {
  write_study("[grid]\nanalysis.duration = [3, 0.05]\n");
  const auto result = run(R"("$BINARY" study s.toml --output out --jobs 2 --quiet &
first=$!
tries=0
while ! ls out/cases/*.exit >/dev/null 2>&1 && [ $tries -lt 3000 ]; do sleep 0.01; tries=$((tries + 1)); done
"$BINARY" study s.toml --output out --quiet
second=$?
kill -KILL $first
exit $second
)");
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_TRUE(says(result.err, "another study")) << result.err;
}

TEST_F(StudyRun, NothingDoneIsAFailure) {
  write_study("[grid]\nblank.coarsening = [30, 40]\n");
  EXPECT_EQ(run("weaveform study s.toml --output out --quiet").exit_code, 3);
  EXPECT_TRUE(fs::exists(file("out/study.csv")));
}

TEST_F(StudyRun, UnknownMeasureIsShownAtItsPlaceAfterTheFirstCase) {
  write_text("scene = \"tiny.toml\"\nmeasures = [\"grips.top.forse_N\"]\n[grid]\nblank.coarsening = [4, 3]\n",
             file("s.toml"));
  const auto result = run("weaveform study s.toml --output out --jobs 1 --quiet");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "s.toml:2:12: measures: no number 'grips.top.forse_N'")) << result.err;
  EXPECT_TRUE(says(result.err, "did you mean 'grips.top.force_N'")) << result.err;
}

TEST_F(StudyRun, WrongStudyFileIsWrongInput) {
  write_study("[grid]\nblank.coarsning = [4]\n");
  const auto result = run("weaveform study s.toml --output out");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "s.toml:4:20: ")) << result.err;
  EXPECT_FALSE(fs::exists(file("out")));
}

TEST_F(StudyRun, SnakemakeGivesTheSameTable) {
  if (run("command -v snakemake").exit_code != 0) GTEST_SKIP() << "snakemake is not installed";
  write_study(
      "[[case]]\nblank.coarsening = 4\n[[case]]\nblank.coarsening = 3\nmodel.formulation = \"contravariant\"\n"
      "[[case]]\nblank.coarsening = 30\n");
  ASSERT_EQ(run("weaveform study s.toml --output snake --export snakemake --quiet").exit_code, 0);
  const auto made =
      run("export XDG_CACHE_HOME=$PWD/cache; snakemake --directory snake --snakefile snake/Snakefile "
          "--cores 2 --quiet --config weaveform=\"$BINARY\"");
  ASSERT_EQ(made.exit_code, 0) << made.err << made.out;
  ASSERT_EQ(run("weaveform study s.toml --output local --quiet").exit_code, 0);
  EXPECT_EQ(read_text(file("snake/study.csv")), read_text(file("local/study.csv")));
}

TEST_F(StudyRun, ExportKeepsTheWordsAndTheOrderOfTheStudy) {
  const std::string axes = "[grid]\nmodel.formulation = [\"energy\"]\nblank.coarsening = [4]\n";
  write_text("# Geflecht für Müller\nscene =  'tiny.toml'  # the ü must not shift it\nmeasures = [\"cells\"]\n" + axes,
             file("s.toml"));
  ASSERT_EQ(run("weaveform study s.toml --output snake --export snakemake --quiet").exit_code, 0);
  EXPECT_TRUE(says(
      read_text(file("snake/study.toml")),
      "# Geflecht für Müller\nscene =  \"scene.toml\"  # the ü must not shift it\nmeasures = [\"cells\"]\n" + axes));
}

TEST_F(StudyRun, ExportOverwritesNothingOfTheUsers) {
  write_study("[grid]\nblank.coarsening = [4]\n");
  fs::create_directory(file("snake"));
  write_text("mine", file("snake/Snakefile"));
  EXPECT_EQ(run("weaveform study s.toml --output snake --export snakemake").exit_code, 2);
  EXPECT_EQ(read_text(file("snake/Snakefile")), "mine");
}

// Linear yarns are stable up to a step factor of 1, and beyond it the run itself fails.
constexpr const char* step_border = R"([set]
model.yarn_law = "linear"
analysis.duration = 0.05
analysis.step_check = false
[grid]
blank.coarsening = [4, 3]
[border]
key = "analysis.step_factor"
holds = 0.9
fails = 1.6
tolerance = 0.1
)";

TEST_F(StudyRun, BorderIsTheSameAfterAKill) {
  write_study(step_border);
  ASSERT_EQ(run(stopped_study("KILL")).exit_code, 137);
  EXPECT_FALSE(fs::exists(file("out/border.csv")));
  const auto partly = run("weaveform study s.toml --output out --collect --quiet");
  EXPECT_EQ(partly.exit_code, 3) << partly.err;
  EXPECT_TRUE(says(read_text(file("out/border.csv")), "not run to the end"));
  const auto resumed = run("weaveform study s.toml --output out --jobs 2");
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ASSERT_EQ(run("weaveform study s.toml --output whole --jobs 1 --quiet").exit_code, 0);
  for (const char* name : {"border.csv", "border.md", "border.svg", "study.csv"})
    EXPECT_EQ(read_text(file("out") / name), read_text(file("whole") / name)) << name;
  const std::string table = read_text(file("out/border.csv"));
  // Halved three times: 0.9875 holds, 1.075 fails.
  for (const char* group : {"4", "3"})
    EXPECT_TRUE(says(table, std::string("\n") + group + ",analysis.step_factor,0.9875,1.075,\"exit code 3: ")) << table;
  EXPECT_TRUE(says(table, ",error,")) << "the run itself says that it fails: " << table;
  const auto again = run("weaveform study s.toml --output out");
  EXPECT_TRUE(says(again.err, "every case has been run before")) << again.err;
  EXPECT_EQ(read_text(file("out/border.csv")), table);
}

TEST_F(StudyRun, BorderOfAWrongSceneStopsWithWhatTheCaseSays) {
  write_study("[border]\nkey = \"blank.coarsening\"\nholds = 4\nfails = 40\n");
  const auto result = run("weaveform study s.toml --output out --quiet");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_TRUE(says(result.err, "blank.coarsening=40: ")) << result.err;
}

TEST_F(StudyRun, BorderIsNoWorkflow) {
  write_study(step_border);
  const auto result = run("weaveform study s.toml --output snake --export snakemake");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(says(result.err, "depends on their results")) << result.err;
  EXPECT_FALSE(fs::exists(file("snake")));
}

TEST_F(StudyRun, RepeatedCasesHaveTheMedianTime) {
  write_text(
      "scene = \"tiny.toml\"\nmeasures = [\"wall_s\", \"grips.top.force_N\"]\nrepeats = 3\n[grid]\n"
      "blank.coarsening = [4, 3]\n",
      file("s.toml"));
  ASSERT_EQ(run("weaveform study s.toml --output out --jobs 1 --quiet").exit_code, 0);
  std::vector<double> walls;
  std::ifstream in(case_file("out", ".walls"));
  for (double wall = 0.0; in >> wall;) walls.push_back(wall);
  ASSERT_EQ(walls.size(), 3U);
  // As after a stop between the second and the third run: only the third is run.
  const fs::path stopped = case_file("out", ".walls");
  write_text("1000\n3000\n", stopped);
  fs::remove(fs::path(stopped).replace_extension(".exit"));
  ASSERT_EQ(run("weaveform study s.toml --output out --quiet").exit_code, 0);
  EXPECT_EQ(read_text(stopped).substr(0, 10), "1000\n3000\n");
  const std::string table = read_text(file("out/study.csv"));
  EXPECT_TRUE(says(table, ",0,,1000,")) << "the median of 1000, 3000 and less: " << table;
  EXPECT_TRUE(says(run("weaveform study s.toml --output out").err, "every case has been run before"));
}

// --accuracy, on a bias extension with linear yarns, whose load at 10 mm is known from meshes finer than those it
// takes.
class AccuracyRun : public StudyRun {
protected:
  [[nodiscard]] double force(const std::string& folder) const {
    return nlohmann::json::parse(read_text(file(folder) / "summary.json"))["grips"]["top"]["force_N"];
  }
  const std::string scene = " tiny.toml --set grip.top.travel=10 --set model.yarn_law=linear ";
};

TEST_F(AccuracyRun, TakesTheCoarsestMeshWithinTheTolerance) {
  ASSERT_EQ(
      run("weaveform run" + scene + "--set blank.coarsening=" + (instrumented ? "1" : "0.8") + " --output fine --quiet")
          .exit_code,
      0);
  for (const double percent : {5.0, 2.0, 1.0}) {
    if (instrumented && percent == 1.0) break;
    // The levels solved for one tolerance serve the next.
    const auto result =
        run("weaveform run" + scene + "--finest 0.25 --output out --accuracy " + std::to_string(percent) + "%");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_TRUE(says(result.err, ": coarsening x 1, in out")) << result.err;
    EXPECT_TRUE(says(result.out, "; limit ")) << result.out;
    EXPECT_NEAR(force("out"), force("fine"), 0.01 * percent * force("fine"));
  }
  EXPECT_TRUE(fs::exists(file("out/result.pvd")));
  EXPECT_TRUE(fs::exists(file("out/accuracy.md")));
}

TEST_F(AccuracyRun, SaysSoWhenItCannot) {
  const auto result = run("weaveform run" + scene + "--accuracy 0.001% --finest 0.5 --output out");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(says(result.err, "cannot be shown")) << result.err;
  EXPECT_TRUE(fs::exists(file("out/summary.json"))) << "the finest mesh is there all the same";
  EXPECT_TRUE(fs::exists(file("out/accuracy.md")));
}

TEST_F(AccuracyRun, WrongArgumentsAreWrongInput) {
  for (const std::string wrong : {"--accuracy 2", "--accuracy 2% --resume", "--finest 0.5", "--measure cells"})
    EXPECT_EQ(run("weaveform run tiny.toml --output out " + wrong).exit_code, 2) << wrong;
}

}  // namespace
