// Borders from the files that cases leave behind, made up here: a method that fails beyond a known value.
#include "app/study/border_report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "app/study/case_files.hpp"
#include "core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform::study {
namespace {

namespace fs = std::filesystem;

// How a case is made up to end: its exit code, and the content of summary.json when it is done.
struct Ending {
  int exit_code = 0;
  std::string summary = "{\"warnings\": []}";
};

class Border : public testing::Test {
protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "scene.toml")
        << "[[grip]]\nname = \"bottom\"\nedge = \"bottom\"\n[[grip]]\nname = \"top\"\nedge = \"top\"\n"
           "travel = 10\n";
  }
  [[nodiscard]] Study read(const std::string& text) const {
    return read_study_text("scene = \"scene.toml\"\n" + text, folder_.path() / "s.toml");
  }
  // Ends every case that the searches want until they want none.
  template <class Method>
  [[nodiscard]] std::vector<BorderGroup> run(const Study& study, const Method& method) const {
    std::vector<BorderGroup> groups;
    for (int round = 0; round < 100; ++round) {
      groups = find_borders(study, folder_.path());
      bool wanted = false;
      for (const BorderGroup& group : groups)
        for (std::size_t i = 0; i < group.tried.size(); ++i) {
          const double value = group.search.tried[i];
          if (std::find(group.search.wanted.begin(), group.search.wanted.end(), value) == group.search.wanted.end())
            continue;
          wanted = true;
          end_case(group.tried[i], method(group.variant, value));
        }
      if (!wanted) break;
    }
    return groups;
  }
  void end_case(const Case& one, const Ending& ending) const {
    const CaseFiles files = case_files(folder_.path(), one.name);
    fs::create_directories(files.results);
    std::ofstream(files.scene) << one.text;
    std::ofstream(files.log) << (ending.exit_code == 0 ? "" : "error: off by 6 %, too much\n");
    if (ending.exit_code == 0) std::ofstream(files.results / "summary.json") << ending.summary;
    std::ofstream(files.exit) << ending.exit_code << "\n";
  }
  [[nodiscard]] const fs::path& folder() const { return folder_.path(); }

private:
  test::TemporaryFolder folder_;
};

constexpr const char* by_step = "[border]\nkey = \"analysis.step_factor\"\nholds = 0.9\nfails = 3.0\n";

double number_in(const Variant& variant, std::size_t at) {
  return *variant.settings.at(at).number;
}

TEST_F(Border, IsFoundForEveryCombination) {
  const Study study =
      read(std::string("[grid]\nblank.coarsening = [2, 4]\nmodel.yarn = [\"truss\", \"beam\"]\n") + by_step);
  const auto groups = run(study, [](const Variant& variant, double value) {
    const double border = 0.5 * number_in(variant, 0) + (variant.settings[1].value == "\"beam\"" ? 0.1 : 0.0);
    return value < border ? Ending{} : Ending{3, ""};
  });
  ASSERT_EQ(groups.size(), 4U);
  const std::vector<double> borders = {1.0, 1.1, 2.0, 2.1};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(groups[i].search.holds, borders[i]);
    EXPECT_GE(groups[i].search.fails, borders[i]);
    EXPECT_EQ(groups[i].failing.caught, "error");
  }
  const std::string csv = border_csv(study, groups);
  EXPECT_NE(csv.find("blank.coarsening,model.yarn,key,holds,fails,failure,caught,cases,complaint\n2,truss,"
                     "analysis.step_factor,0."),
            std::string::npos)
      << csv;
  EXPECT_NE(csv.find(",\"exit code 3: off by 6 %, too much\",error,"), std::string::npos) << csv;
  const auto chart = border_chart(study, groups);
  ASSERT_TRUE(chart.has_value());
  ASSERT_EQ(chart->series.size(), 2U) << "one for each yarn, over the coarsening";
  EXPECT_EQ(chart->series[0].label, "beam");
  EXPECT_EQ(chart->series[0].x, (std::vector<double>{2.0, 4.0}));
  EXPECT_NEAR(chart->series[0].y[1], 2.1, 0.03);
}

TEST_F(Border, WithoutOneOthersAreStillFound) {
  const Study study = read(std::string("[grid]\nblank.coarsening = [2, 4]\n") + by_step);
  const auto groups = run(study, [](const Variant& variant, double value) {
    return number_in(variant, 0) > 3.0 || value < 2.0 ? Ending{} : Ending{139, ""};
  });
  EXPECT_TRUE(border_is_found(groups[0])) << "a crash is a failure";
  EXPECT_EQ(groups[0].failing.caught, "no");
  EXPECT_FALSE(border_is_found(groups[1]));
  EXPECT_EQ(border_group_complaint(groups[1]),
            "blank.coarsening=4: no border between 0.9 and 3: it holds on both ends; move 'fails' on from 3");
  EXPECT_NE(border_csv(study, groups).find("\n4,analysis.step_factor,,,,,2,no border"), std::string::npos);
}

TEST_F(Border, ConditionsAreAllToBeMet) {
  const Study study = read(std::string(by_step) +
                           "[[border.while]]\nmeasure = \"error\"\nat_most = 0.01\nat_least = -0.01\n"
                           "[[border.while]]\nmeasure = \"force\"\nwithin = 0.05\nof = \"ideal\"\n"
                           "[[border.while]]\nmeasure = \"force\"\nwithin = 0.1\nof = \"holds\"\n"
                           "[[border.while]]\nmeasure = \"force\"\nwithin = 0.2\nof = 90\n"
                           "[[border.while]]\nno_warnings = true\n");
  const auto border = [&](const std::string& beyond, double* caught_border) {
    fs::remove_all(folder() / "cases");
    const auto groups = run(study, [&](const Variant&, double value) {
      return Ending{0, value < 1.5 ? R"({"error": 0, "force": 100, "ideal": 101, "warnings": []})" : beyond};
    });
    EXPECT_TRUE(border_is_found(groups[0])) << groups[0].search.complaint;
    *caught_border = groups[0].search.fails;
    return groups[0].failing.reason + " (" + groups[0].failing.caught + ")";
  };
  double fails = 0.0;
  EXPECT_EQ(border(R"({"error": 0.02, "force": 100, "ideal": 101, "warnings": []})", &fails),
            "error is 0.02, not at most 0.01 (no)");
  EXPECT_NEAR(fails, 1.5, 0.03);
  EXPECT_EQ(border(R"({"error": -0.02, "force": 100, "ideal": 101, "warnings": []})", &fails),
            "error is -0.02, not at least -0.01 (no)");
  EXPECT_EQ(border(R"({"error": null, "force": 100, "ideal": 101, "warnings": []})", &fails),
            "error is nan, not at most 0.01 (no)");
  EXPECT_EQ(border(R"({"error": 0, "force": 100, "ideal": 110, "warnings": []})", &fails),
            "force is 100, not within 5 % of 110 (no)");
  EXPECT_EQ(border(R"({"error": 0, "force": 89, "ideal": 89, "warnings": ["folds"]})", &fails),
            "force is 89, not within 10 % of 100 (warning)");
  EXPECT_EQ(border(R"({"error": 0, "force": 109, "ideal": 109, "warnings": ["folds"]})", &fails),
            "force is 109, not within 20 % of 90 (warning)");
  EXPECT_EQ(border(R"({"error": 0, "force": 100, "ideal": 100, "warnings": ["folds", "more"]})", &fails),
            "warning: folds (warning)");
}

TEST_F(Border, AMeasureThatIsNotThereIsAnErrorAtItsCondition) {
  const Study study = read(std::string(by_step) + "[[border.while]]\nmeasure = \"forse\"\nat_most = 1\n");
  try {
    (void)run(study, [](const Variant&, double) { return Ending{0, R"({"force": 1, "warnings": []})"}; });
    FAIL();
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_NE(line.find("s.toml:6:1: no number 'forse'"), std::string::npos) << line;
    EXPECT_NE(line.find("did you mean 'force'?"), std::string::npos) << line;
  }
}

TEST_F(Border, WhatIsNotRunIsSaid) {
  const Study study = read(by_step);
  const auto groups = find_borders(study, folder());
  EXPECT_FALSE(border_is_found(groups[0]));
  EXPECT_EQ(border_csv(study, groups),
            "key,holds,fails,failure,caught,cases,complaint\nanalysis.step_factor,,,,,0,not run to the end\n");
  EXPECT_FALSE(border_chart(study, groups).has_value());
}

TEST_F(Border, WrongTablesAreErrorsWithTheirPlace) {
  const auto complaints = [&](const std::string& text) {
    try {
      (void)border_ends(read(text));
    } catch (const InputError& error) {
      std::string all = error.what();
      for (auto at = all.find(folder().string() + "/"); at != std::string::npos; at = all.find(folder().string() + "/"))
        all.erase(at, folder().string().size() + 1);
      return all;
    }
    return std::string("none");
  };
  const std::string border = by_step;
  EXPECT_EQ(complaints(border), "none");
  EXPECT_EQ(complaints("[set]\nanalysis.step_factor = 1\n" + border),
            "s.toml:5:7: 'analysis.step_factor' is bisected here and set elsewhere; leave it out of [set] and of what "
            "is varied");
  EXPECT_EQ(complaints("[border]\nkey = \"analysis.step_factr\"\nholds = 1\nfails = 2\n").substr(0, 32),
            "s.toml:2:1: analysis.step_factr:");
  EXPECT_EQ(complaints("[border]\nkey = \"analysis.step_factor\"\nholds = 1\n"),
            "s.toml:2:1: [border] lacks the required key 'fails'; add fails = a number");
  EXPECT_EQ(complaints("[border]\nkey = \"analysis.step_factor\"\nholds = 1\nfails = 9\n"),
            "s.toml:2:1: analysis.step_factor: 'step_factor' is 9; it must be >= 0.0001 and <= 4");
  EXPECT_EQ(complaints(border + "tolerence = 1\n"),
            "s.toml:6:1: unknown key 'tolerence' in [border]; did you mean 'tolerance'?");
  EXPECT_EQ(complaints(border + "[[border.while]]\nmeasure = \"a\"\n"),
            "s.toml:6:1: [[border.while]] says nothing of 'a'; add at_most, at_least, or within and of");
  EXPECT_EQ(complaints(border + "[[border.while]]\nat_most = 1\n"),
            "s.toml:6:1: [[border.while]] compares, but no 'measure'; add the one it is about");
  EXPECT_EQ(complaints(border + "[[border.while]]\nmeasure = \"a\"\nwithin = 0.1\n"),
            "s.toml:6:1: 'within' and 'of' go together: |measure - of|/|of| is at most 'within'; add the other");
  EXPECT_EQ(complaints(border + "[[border.while]]\nmeasure = \"a\"\nwithin = 0.1\nof = 0\n").substr(0, 19),
            "s.toml:9:6: 'of' is");
  EXPECT_EQ(complaints(border + "[[border.while]]\n"),
            "s.toml:6:1: [[border.while]] asks for nothing; add a measure, or no_warnings = true");
  EXPECT_EQ(complaints(border + "[[border.while]]\nmeasure = 3\nat_most = \"a\"\n"),
            "s.toml:7:11: 'measure' is a whole number; it must be text\n"
            "s.toml:8:11: 'at_most' is text; it must be a number");
  EXPECT_EQ(complaints("[border]\nkey = \"analysis.step_factor\"\nholds = 1\nfails = 1\n").substr(0, 12),
            "s.toml:5:9: ");
  EXPECT_EQ(complaints("[border]\nkey = \"analysis.damping\"\nholds = 0\nfails = 1\nscale = \"logarithmic\"\n"),
            "s.toml:2:1: scale = \"logarithmic\" needs 'holds' and 'fails' > 0; use \"linear\"");
  EXPECT_EQ(complaints("repeats = 2\n" + border).substr(0, 34), "s.toml:2:11: 'repeats' does not go");
  EXPECT_EQ(complaints(border + "[convergence]\nkey = \"analysis.step_factor\"\n").substr(0, 30),
            "s.toml:6:1: [convergence] does");
}

}  // namespace
}  // namespace weaveform::study
