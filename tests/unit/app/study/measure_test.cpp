// Numbers of a result folder by name, and how a case is said to have ended.
#include "app/study/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/study/case_files.hpp"
#include "core/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace weaveform::study {
namespace {

class Measure : public testing::Test {
protected:
  void SetUp() override {
    std::ofstream(folder_.path() / "summary.json")
        << R"({"cells": 7, "good": true, "lost": null, "word": "x", "grips": {"to.p": {"force_N": 2.5}, "to": {"p": 1}},
               "travel": [{"a": 1}, {"a": 3}]})";
    std::ofstream(folder_.path() / "history.csv") << "time_s,top.force_N\n0,1\n1,-4\n2,3\n3,2\n";
  }
  [[nodiscard]] double value(const std::string& name) const { return measure(folder_.path(), name); }
  [[nodiscard]] std::string complaint(const std::string& name) const {
    try {
      (void)value(name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  test::TemporaryFolder folder_;
};

TEST_F(Measure, IsANumberOfTheSummaryByItsPath) {
  EXPECT_EQ(value("cells"), 7.0);
  EXPECT_EQ(value("good"), 1.0);
  EXPECT_TRUE(std::isnan(value("lost")));
  EXPECT_EQ(value("grips.to.p.force_N"), 2.5) << "names may hold dots";
  EXPECT_EQ(value("grips.to.p"), 1.0);
  EXPECT_EQ(value("travel.1.a"), 3.0);
}

TEST_F(Measure, IsTheLastGreatestOrLeastOfAColumn) {
  EXPECT_EQ(value("last(top.force_N)"), 2.0);
  EXPECT_EQ(value("max(top.force_N)"), 3.0);
  EXPECT_EQ(value("min(top.force_N)"), -4.0);
}

TEST_F(Measure, OfNoNumberNamesTheNearest) {
  EXPECT_EQ(complaint("cels"), "no number 'cels' in summary.json; did you mean 'cells'?");
  EXPECT_EQ(complaint("last(top.forse_N)"), "no column 'top.forse_N' in history.csv; did you mean 'top.force_N'?");
  EXPECT_NE(complaint("word"), "none");
  EXPECT_NE(complaint("grips"), "none");
}

TEST_F(Measure, ErrorLineNamesFilesAsTheyLieBesideEachOther) {
  const auto log = folder_.path() / "00ab.log";
  std::ofstream(log) << "error: first\nerror: /some/where/cases/00ab.toml:3:1: wrong\nnot this\n";
  EXPECT_EQ(error_line(log, 2), "00ab.toml:3:1: wrong");
  EXPECT_EQ(error_line(folder_.path() / "none.log", 139), "killed by signal 11 (Segmentation fault)");
  EXPECT_EQ(error_line(log, 0), "");
}

}  // namespace
}  // namespace weaveform::study
