// Matrices of one component each (MatchID, Ncorr, OpenCorr): sisters, grids, and what a name or a value leaves open.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "post/dic/readers/matrix_files.hpp"
#include "post/dic/readers/measurement.hpp"
#include "tests/unit/post/dic/dic_reader.hpp"

namespace {

using namespace weaveform;
using namespace weaveform::dic;
using test::says;
using test::write_text;

class DicMatrix : public DicReader {
protected:
  // u = 0.1 (c - 7), v = -0.05 (r - 5) in mm, decimal commas
  void write_matrix(const std::string& name, bool is_u, const std::string& word = "") {
    std::string text;
    for (int r = 0; r < 11; ++r)
      for (int c = 0; c < 15; ++c) {
        std::string cell = fmt::format("{:.6f}", is_u ? 0.1 * (c - 7) : -0.05 * (r - 5));
        std::replace(cell.begin(), cell.end(), '.', ',');
        if (r == 2 && c == 3 && !word.empty()) cell = word;
        text += fmt::format("{}{}", cell, c == 14 ? '\n' : ';');
      }
    write_text(text, folder_.path() / name);
  }
  MeasuredStage stage(const std::string& name) { return read_stages(folder_.path() / name, spec).front(); }
};

TEST_F(DicMatrix, SistersAreFoundAndFailedPointsAreWords) {
  write_matrix("stage1_U[mm].csv", true);
  write_matrix("stage1_V[mm].csv", false, "Non un numero reale");
  spec.grid_step = 20.0;
  spec.grid_first = {300.0, 200.0};
  spec.pixel_size = 0.05;
  spec.y_axis = dic::YAxis::down;
  for (const char* name : {"stage1_U[mm].csv", "stage1_V[mm].csv"}) {
    const MeasuredStage one = stage(name);
    ASSERT_EQ(one.size(), 165U);
    EXPECT_EQ(one.failed, 1);
    EXPECT_FALSE(one.valid[2 * 15 + 3]);
    EXPECT_NEAR(one.reference[16][0], 0.05 * 320.0, 1e-12);
    EXPECT_NEAR(one.reference[16][1], -0.05 * 220.0, 1e-12);
    EXPECT_NEAR(one.displacement_field[16][0], -0.6, 1e-12);
    EXPECT_NEAR(one.displacement_field[16][1], -0.2, 1e-12) << "down, turned up";
    EXPECT_TRUE(noted(one, "'Non un numero reale'"));
  }
  // rows go down whichever way v counts
  spec.y_axis = dic::YAxis::up;
  EXPECT_NEAR(stage("stage1_U[mm].csv").reference[16][1], -0.05 * 220.0, 1e-12);
  EXPECT_NEAR(stage("stage1_U[mm].csv").displacement_field[16][1], 0.2, 1e-12);
}

TEST_F(DicMatrix, EverythingUnknownIsAskedAtOnceWithItsKey) {
  write_matrix("plot_u_dic.csv", true);
  write_matrix("plot_v_dic.csv", false);
  const auto questions = read_stages_asking(folder_.path() / "plot_u_dic.csv", spec).front().questions;
  std::vector<std::string> keys;
  for (const Question& question : questions) keys.push_back(question.key);
  for (const char* key :
       {"measurement.length_unit", "measurement.grid_step", "measurement.pixel_size", "measurement.y_axis"})
    EXPECT_EQ(std::count(keys.begin(), keys.end(), key), 1) << key;
  spec.length_unit = dic::MeasuredUnit::mm;
  spec.grid_pitch = 1.5;
  spec.y_axis = dic::YAxis::up;
  EXPECT_NEAR(stage("plot_u_dic.csv").reference[1][0], 1.5, 1e-12) << "a pitch in mm needs no pixel";
}

TEST_F(DicMatrix, AFolderOfMatricesIsOneStageForEachPair) {
  for (const char* stage_name : {"s1", "s2", "s10"}) {
    write_matrix(fmt::format("{}_U[mm].csv", stage_name), true);
    write_matrix(fmt::format("{}_V[mm].csv", stage_name), false);
    write_matrix(fmt::format("{}_Exx[ ].csv", stage_name), false);
  }
  write_text("words", folder_.path() / "notes.txt");
  const auto files = measurement_files({folder_.path().string()});
  ASSERT_EQ(files.size(), 3U);
  EXPECT_EQ(files[0].filename(), "s1_U[mm].csv");
  EXPECT_EQ(files[2].filename(), "s10_U[mm].csv");
  EXPECT_EQ(measurement_files({(folder_.path() / "s2_V[mm].csv").string()}).at(0).filename(), "s2_U[mm].csv");
}

TEST_F(DicMatrix, TheComponentIsAWordOfTheName) {
  struct Case {
    const char* name;
    char component;
    const char* unit;
  };
  for (const Case& c : std::vector<Case>{{"stage1_U[mm].csv", 'u', "mm"},
                                         {"plot_v_dic_3.csv", 'v', ""},
                                         {"W.txt", 'w', ""},
                                         {"disp_x.csv", 'u', ""},
                                         {"disp_y (px).csv", 'v', "px"},
                                         {"run_x_Uy.csv", 'v', ""},
                                         {"stage1_X[mm].csv", 'x', "mm"},
                                         {"Displacement U [mm]_0002.csv", 'u', "mm"}}) {
    const auto name = matrix_name(c.name);
    ASSERT_TRUE(name.has_value()) << c.name;
    EXPECT_EQ(name->component, c.component) << c.name;
    EXPECT_EQ(name->unit, c.unit) << c.name;
  }
  for (const char* name : {"stage1.csv", "volume.csv", "stage_uv.csv", "[U].csv"})
    EXPECT_FALSE(matrix_name(name).has_value()) << name;
}

TEST_F(DicMatrix, MatricesOfPlacesReplaceTheGrid) {
  write_matrix("s_U[mm].csv", true);
  write_matrix("s_V[mm].csv", false);
  write_matrix("s_X[mm].csv", true);   // 0.1 (c - 7)
  write_matrix("s_Y[mm].csv", false);  // -0.05 (r - 5)
  spec.y_axis = dic::YAxis::up;
  const MeasuredStage one = stage("s_X[mm].csv");
  EXPECT_NEAR(one.reference[16][0], -0.6, 1e-12);
  EXPECT_NEAR(one.reference[16][1], 0.2, 1e-12);
  EXPECT_TRUE(noted(one, "places by s_X[mm].csv and s_Y[mm].csv"));
}

TEST_F(DicMatrix, ZerosByTheHundredAreAskedAbout) {
  std::string zeros;
  for (int r = 0; r < 10; ++r) zeros.append(r < 5 ? "0 0 0 0 0\n" : "1 2 3 4 5\n");
  write_text(zeros, folder_.path() / "u.txt");
  write_text(zeros, folder_.path() / "v.txt");
  spec.length_unit = dic::MeasuredUnit::px;
  spec.pixel_size = 0.1;
  spec.grid_step = 5.0;
  try {
    (void)stage("u.txt");
    FAIL() << "zeros outside the region were taken for measured";
  } catch (const InputError& error) {
    EXPECT_TRUE(says(error.what(), "25 of 50 points")) << error.what();
    EXPECT_TRUE(says(error.what(), "--set measurement.grid_zeros=missing")) << error.what();
  }
  spec.grid_zeros = dic::GridZeros::missing;
  EXPECT_EQ(good(stage("u.txt")), 25);
  spec.grid_zeros = dic::GridZeros::measured;
  EXPECT_EQ(good(stage("u.txt")), 50);
}

TEST_F(DicMatrix, WithoutASisterOrANameItSaysWhatIsMissing) {
  write_matrix("one_U[mm].csv", true);
  write_matrix("matrix.csv", true);
  for (const auto& [name, words] : {std::pair("one_U[mm].csv", "there is none of V beside it"),
                                    {"matrix.csv", "export one table with columns x, y, u and v"}})
    try {
      (void)stage(name);
      FAIL() << name;
    } catch (const InputError& error) {
      EXPECT_TRUE(says(error.what(), words)) << error.what();
    }
}

}  // namespace
