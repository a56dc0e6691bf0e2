// Study files: what cases they stand for, and what is said about wrong ones.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "app/study/border_run.hpp"
#include "app/study/cases.hpp"
#include "app/study/report.hpp"
#include "app/study/study_spec.hpp"
#include "core/error.hpp"
#include "core/files/files.hpp"
#include "mesher/scene/reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform::study {
namespace {

using Lines = std::vector<std::string>;

class StudyFile : public testing::Test {
protected:
  void SetUp() override {
    std::ofstream(scene_)
        << "[[grip]]\nname = \"bottom\"\nedge = \"bottom\"\n[[grip]]\nname = \"top\"\nedge = \"top\"\n"
           "travel = 10\n";
  }
  [[nodiscard]] Study read(const std::string& text) const {
    return read_study_text("scene = \"scene.toml\"\n" + text, folder_.path() / "s.toml");
  }
  [[nodiscard]] Lines described(const std::string& text) const {
    Lines lines;
    for (const Case& one : expand(read(text))) lines.push_back(describe(one));
    return lines;
  }
  // Complaints with the folder left out.
  [[nodiscard]] Lines complaints(const std::string& text) const {
    Lines lines;
    try {
      (void)expand(read(text));
    } catch (const InputError& error) {
      lines = error.complaints();
    }
    const std::string folder = folder_.path().string() + "/";
    for (std::string& line : lines)
      if (line.starts_with(folder)) line.erase(0, folder.size());
    return lines;
  }
  test::TemporaryFolder folder_;
  std::filesystem::path scene_ = folder_.path() / "scene.toml";
};

TEST_F(StudyFile, GridIsEveryCombinationTheLastKeyFastest) {
  EXPECT_EQ(described("[grid]\nmodel.formulation = [\"energy\", \"contravariant\"]\nblank.coarsening = [4, 2]\n"),
            (Lines{"model.formulation=\"energy\" blank.coarsening=4", "model.formulation=\"energy\" blank.coarsening=2",
                   "model.formulation=\"contravariant\" blank.coarsening=4",
                   "model.formulation=\"contravariant\" blank.coarsening=2"}));
}

TEST_F(StudyFile, PairedValuesGoTogether) {
  EXPECT_EQ(described("[[paired]]\nblank.coarsening = [4, 2]\nanalysis.duration = [0.1, 0.2]\n"),
            (Lines{"blank.coarsening=4 analysis.duration=0.1", "blank.coarsening=2 analysis.duration=0.2"}));
}

TEST_F(StudyFile, CasesMayLeaveKeysOut) {
  EXPECT_EQ(described("[[case]]\n[[case]]\ngrip.top.travel = 5.5\nmodel.yarn = \"seatbelt\"\n[grid]\n"
                      "blank.coarsening = [4]\n"),
            (Lines{"blank.coarsening=4", "grip.top.travel=5.5 model.yarn=\"seatbelt\" blank.coarsening=4"}));
}

TEST_F(StudyFile, ASeriesIsNoSetting) {
  const auto cases =
      expand(read("[[case]]\nseries = \"soft yarns\"\nmodel.yarn_stiffness_scale = 0.1\n[[case]]\n"
                  "[grid]\nblank.coarsening = [4, 2]\n"));
  ASSERT_EQ(cases.size(), 4U);
  EXPECT_EQ(cases[1].series, "soft yarns");
  EXPECT_EQ(describe(cases[1]), "model.yarn_stiffness_scale=0.1 blank.coarsening=2");
  EXPECT_EQ(cases[2].series, "");
  EXPECT_EQ(complaints("[[case]]\nseries = 3\nblank.coarsening = 4\n"),
            Lines{"s.toml:3:10: 'series' is a whole number; it must be text"});
}

TEST_F(StudyFile, ACaseIsTheSceneWithItsOverrides) {
  const auto cases = expand(read("[set]\noutput.frames = 3\n[grid]\nblank.size = [[115, 230], [120.5, 240]]\n"));
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[1].text, scene_to_toml(read_scene(scene_, {"output.frames=3", "blank.size=[120.5,240]"})));
}

// The name follows from the scene alone: neither other cases, nor the way it is written, nor defaults written out
// matter.
TEST_F(StudyFile, EqualScenesHaveOneNameAndOthersHaveOthers) {
  const auto few = expand(read("[grid]\nblank.coarsening = [4]\n"));
  const auto many = expand(read("[set]\nmodel.yarn = \"truss\"\n[grid]\nblank.coarsening = [2, 3, [4.0, 4], 4]\n"));
  EXPECT_EQ(few[0].name, many[2].name);
  EXPECT_EQ(few[0].name, many[3].name);
  std::set<std::string> names;
  for (const Case& one : many) names.insert(one.name);
  EXPECT_EQ(names.size(), 3U);
}

TEST_F(StudyFile, TheContentOfACardBelongsToTheCase) {
  const auto card = folder_.path() / "own.toml";
  const auto with_card = [&] {
    return expand(read("[set]\nfabric.material = \"./own.toml\"\n[grid]\nblank.coarsening = [4]\n")).front().name;
  };
  std::ofstream(card) << "a = 1\n";
  const auto before = with_card();
  EXPECT_EQ(before, with_card());
  std::ofstream(card) << "a = 2\n";
  EXPECT_NE(before, with_card());
}

TEST_F(StudyFile, ComplaintsPointIntoTheStudyFile) {
  EXPECT_EQ(complaints("[grid]\nblank.coarsning = [4]\n"),
            Lines{"s.toml:3:20: blank.coarsning: unknown key 'coarsning' in [blank]; did you mean 'coarsening'?"});
  EXPECT_EQ(complaints("[grid]\nblank.coarsening = [4, -1, 2]\n"),
            Lines{"s.toml:3:24: blank.coarsening: 'coarsening' is -1; it must be >= 0.05 and <= 100"});
  EXPECT_EQ(complaints("[grid]\ngrip.tpo.travel = [4]\n").at(0).substr(0, 28), "s.toml:3:20: grip.tpo.travel");
  EXPECT_EQ(complaints("[grid]\nblank.coarsening = 4\n"),
            Lines{"s.toml:3:20: 'blank.coarsening' must be a list of values; write it in [ ]"});
  EXPECT_EQ(complaints("mesures = [\"a\"]\n[grid]\nblank.coarsening = [4]\n"),
            Lines{"s.toml:2:1: unknown key 'mesures' in a study file; did you mean 'measures'?"});
}

TEST_F(StudyFile, AllComplaintsComeAtOnce) {
  EXPECT_EQ(complaints("[grid]\nblank.coarsening = [4, -1]\noutput.frames = [-2, 3]\n").size(), 2U);
}

// Those that take minutes are run by no test: their scenes and tables at least are in order.
TEST(StudyFiles, OfTheProjectAreInOrder) {
  const std::filesystem::path root = WEAVEFORM_SOURCE_DIR;
  int count = 0;
  for (const auto& folder : {root / "examples" / "studies", root / "bench" / "accuracy"})
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      // Scenes of studies lie beside them.
      if (entry.path().extension() != ".toml" || read_text_file(entry.path()).find("\nscene = ") == std::string::npos)
        continue;
      const Study study = read_study(entry.path());
      EXPECT_FALSE((study.border ? border_ends(study) : expand(study)).empty()) << entry.path();
      EXPECT_FALSE(measures_of(study).all.empty()) << entry.path();
      ++count;
    }
  EXPECT_GE(count, 5);
}

TEST_F(StudyFile, KeysBelongToOneAxis) {
  EXPECT_EQ(
      complaints("[set]\nblank.coarsening = 2\n[grid]\nblank.coarsening = [4]\n"),
      Lines{"s.toml:5:21: 'blank.coarsening' is set twice; keep it in one of [set], [grid], [[paired]] and [[case]]"});
  EXPECT_EQ(
      complaints("[[paired]]\nblank.coarsening = [4, 2]\nanalysis.duration = [1]\n"),
      Lines{"s.toml:4:21: 'analysis.duration' has 1 values, but those it is paired with have 2; give one for each"});
  EXPECT_EQ(complaints(""),
            Lines{"s.toml:1:1: the study varies nothing; add [grid], [[paired]], [[case]] or [border]"});
}

TEST_F(StudyFile, ConvergenceNeedsThreeNumbersOfAVariedKey) {
  const std::string grid = "[grid]\nblank.coarsening = [4, 2, 1]\nmodel.formulation = [\"energy\"]\n[convergence]\n";
  EXPECT_TRUE(complaints(grid + "key = \"blank.coarsening\"\n").empty());
  EXPECT_EQ(complaints(grid + "key = \"blank.coarsning\"\n"),
            Lines{"s.toml:6:7: 'blank.coarsning' is not varied; did you mean 'blank.coarsening'?"});
  EXPECT_EQ(complaints(grid + "key = \"model.formulation\"\n").size(), 2U);
  EXPECT_EQ(complaints(grid), Lines{"s.toml:5:1: [convergence] lacks the required key 'key'; add key = text"});
}

TEST_F(StudyFile, WorkPrecisionNeedsAReference) {
  const std::string grid = "[grid]\nblank.coarsening = [4, 2, 1]\n[work_precision]\n";
  EXPECT_EQ(complaints(grid),
            Lines{"s.toml:4:1: reference = \"limit\" needs [convergence]; add it, or set reference = \"case\""});
  EXPECT_EQ(complaints(grid + "reference = \"case\"\n").size(), 1U);
  EXPECT_TRUE(complaints(grid + "reference = \"case\"\ncase.blank.coarsening = 1\n").empty());
}

TEST_F(StudyFile, EachReferenceHasItsOwnTables) {
  const std::string grid = "[grid]\nblank.coarsening = [4, 2, 1]\n[convergence]\nkey = \"blank.coarsening\"\n";
  EXPECT_TRUE(complaints(grid + "[work_precision]\nlimit_of.blank.coarsening = 1\n").empty());
  EXPECT_EQ(complaints(grid + "[work_precision]\nlimit_of.blank.coarsning = 1\n"),
            Lines{"s.toml:7:28: 'blank.coarsning' is not varied; did you mean 'blank.coarsening'?"});
  EXPECT_EQ(complaints(grid + "[work_precision]\nvalue.force = 1\n"),
            Lines{"s.toml:7:1: [work_precision.value] has no meaning with reference = \"limit\"; set reference = "
                  "\"value\""});
  EXPECT_EQ(complaints(grid + "[work_precision]\nuncertainty.force = 1\n").size(), 1U);
  EXPECT_TRUE(complaints(grid + "[work_precision]\nreference = \"value\"\nvalue.force = \"ideal.force_N\"\n"
                                "uncertainty.force = 0.5\n")
                  .empty());
  EXPECT_EQ(complaints(grid + "[work_precision]\nreference = \"value\"\n").size(), 1U);
  EXPECT_EQ(complaints(grid + "[work_precision]\nreference = \"value\"\nvalue.force = true\n"),
            Lines{"s.toml:8:15: 'force' must be a number, or the name of another measure of the same case"});
}

TEST_F(StudyFile, WhatIsComparedMustBeCharted) {
  const auto check = [&](const std::string& text) {
    try {
      const Study study = read(
          "measures = [\"force\"]\n[grid]\nblank.coarsening = [4]\n[work_precision]\n"
          "reference = \"value\"\n" +
          text);
      (void)measures_of(study);
    } catch (const InputError& error) {
      return std::string(error.what()).substr(folder_.path().string().size() + 1);
    }
    return std::string("none");
  };
  EXPECT_EQ(check("value.force = 1\n"), "none");
  EXPECT_EQ(check("value.force = 1\nvalue.forse = 2\n"),
            "s.toml:8:15: [work_precision.value]: 'forse' is not charted; did you mean 'force'?");
  EXPECT_EQ(check("measures = [\"force\", \"a\"]\nvalue.force = 1\n"),
            "s.toml:5:1: [work_precision.value] does not say what 'a' should be; add it, or list the measures to be "
            "charted");
  EXPECT_EQ(check("absolute = [\"angle\"]\nvalue.force = 1\n").substr(0, 37), "s.toml:5:1: [work_precision] absolute");
}

}  // namespace
}  // namespace weaveform::study
