// What goes wrong in tests of bending is put right, or complained of in a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/bending_readings.hpp"

namespace weaveform {
namespace {

using test::bending_truth;
using test::covered;
using test::Points;
using test::table;
using test::table_fit;

class FitBendingTraps : public testing::Test {
protected:
  void write(const std::string& name, const Points& points) { folder.write_curve(name, points.x, points.y); }
  std::string complaint(const std::string& text) { return folder.complaint(text); }
  test::FitFolder folder;
  std::mt19937 random{1};
};

TEST_F(FitBendingTraps, AClampToeIsTakenOut) {
  Points points = table(1.0, 0.0, random);
  constexpr double toe = 0.002;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double x = points.x[i];
    points.y[i] = x < 2.0 * toe ? bending_truth.moment(toe) * x * x / (4.0 * toe * toe) : bending_truth.moment(x - toe);
  }
  write("a.csv", points);
  const auto found = folder.identify(table_fit("'a.csv'"));
  EXPECT_LT(test::worst_error(found.bends.at(0)), 0.03);
  EXPECT_NE(found.bends[0].specimens[0].notes.at(0).find("toe"), std::string::npos);
}

// The strip lifts out of the jaws beside the clamp: what hangs beyond is as it was.
TEST_F(FitBendingTraps, AStripThatTiltsInItsClampHasTheSameLaw) {
  Points points = test::profile(160.0, 1.0, 0.05, random);
  constexpr double tilt = 0.03;  // rad; the whole strip turns with its clamp: not exactly the level one's shape
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const double x = points.x[i], y = points.y[i];
    points.x[i] = x + tilt * y;
    points.y[i] = y - tilt * x;
  }
  write("a.csv", points);
  const auto found = folder.identify(test::strip_fit("'a.csv'"));
  EXPECT_LT(test::worst_error(found.bends.at(0)), 0.08);
}

TEST_F(FitBendingTraps, ProfilesThatCrossAreComplainedOf) {
  write("short.csv", test::profile(140.0, 1.0, 0.1, random));
  write("long.csv", test::profile(160.0, 4.0, 0.1, random));
  const std::string said = complaint(test::strip_fit("'short.csv', 'long.csv'"));
  EXPECT_NE(said.find("long.csv: the strip of 160"), std::string::npos) << said;
  EXPECT_NE(said.find("hangs lower everywhere"), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
}

TEST_F(FitBendingTraps, AProfileThatCrossesItselfIsComplainedOf) {
  Points points = test::profile(160.0, 1.0, 0.0, random);
  std::rotate(points.x.begin() + 20, points.x.begin() + 45, points.x.begin() + 60);
  std::rotate(points.y.begin() + 20, points.y.begin() + 45, points.y.begin() + 60);
  for (std::size_t i = 20; i < 60; ++i) points.y[i] += i % 2 == 0 ? 15.0 : -15.0;
  write("a.csv", points);
  const std::string said = complaint(test::strip_fit("'a.csv'"));
  EXPECT_NE(said.find("a.csv"), std::string::npos) << said;
  EXPECT_NE(said, "");
}

TEST_F(FitBendingTraps, WrongUnitsAreAskedAboutInOneLine) {
  write("a.csv", table(1.0, 0.0, random));
  const std::string columns =
      test::head_of_fit +
      "[[moment_curvature]]\nname = 'bend'\nfiles = ['a.csv']\ncurvature_column = 'x'\nmoment_column = 'y'\n";
  const std::string curvature = complaint(columns + "curvature_unit = '1/m'\nmoment_unit = 'N'\n");
  EXPECT_NE(curvature.find("is curvature_unit really '1/m' (1/cm or 1/mm"), std::string::npos) << curvature;
  Points in_metres = test::profile(160.0, 1.0, 0.0, random);
  for (auto* values : {&in_metres.x, &in_metres.y})
    for (double& value : *values) value *= 1e-3;
  write("m.csv", in_metres);
  const std::string length = complaint(test::strip_fit("'m.csv'", "overhangs = [160]\n"));
  EXPECT_NE(length.find("really 'mm' (m would fit)"), std::string::npos) << length;
  Points stiff = table(1e4, 0.0, random);
  write("k.csv", stiff);
  const std::string moment = complaint(table_fit("'k.csv'"));
  EXPECT_NE(moment.find("is moment_unit really 'N'"), std::string::npos) << moment;
  for (const auto& said : {curvature, length, moment}) EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 0) << said;
}

TEST_F(FitBendingTraps, AHeadingThatNamesAnotherUnitIsAskedAbout) {
  const Points points = table(1.0, 0.0, random);
  std::string text = "curvature (1/m),moment (N mm)\n";
  for (std::size_t i = 0; i < points.x.size(); ++i) text += fmt::format("{},{}\n", points.x[i], points.y[i]);
  folder.write("a.csv", text);
  const std::string columns = test::head_of_fit +
                              "[[moment_curvature]]\nname = 'bend'\nfiles = ['a.csv']\ncurvature_column = '1'\n"
                              "moment_column = '2'\n";
  EXPECT_NE(complaint(columns + "curvature_unit = '1/cm'\nmoment_unit = 'N'\n").find("which is right?"),
            std::string::npos);
  const std::string of_whole = complaint(columns + "curvature_unit = '1/m'\nmoment_unit = 'N mm/mm'\n");
  EXPECT_NE(of_whole.find("moment_unit = \"N mm\""), std::string::npos) << of_whole;
}

TEST_F(FitBendingTraps, HeightsThatCountDownwardsAreAskedAbout) {
  Points points = test::profile(160.0, 1.0, 0.1, random);
  for (double& y : points.y) y = -y;
  write("a.csv", points);
  EXPECT_NE(complaint(test::strip_fit("'a.csv'")).find("say y_factor = -1"), std::string::npos);
  EXPECT_EQ(complaint(test::strip_fit("'a.csv'", "y_factor = -1\n")), "");
}

// From the tip to the clamp, towards negative x, with the part in the jaws: as good as the plain one.
TEST_F(FitBendingTraps, AProfileTheOtherWayRoundIsTurned) {
  Points points = test::profile(160.0, 1.0, 0.0, random);
  for (int i = 0; i < 10; ++i) {
    points.x.insert(points.x.begin(), -2.0 * (i + 1));
    points.y.insert(points.y.begin(), 0.0);
  }
  std::reverse(points.x.begin(), points.x.end());
  std::reverse(points.y.begin(), points.y.end());
  for (double& x : points.x) x = -x;
  write("a.csv", points);
  const auto found = folder.identify(test::strip_fit("'a.csv'"));
  EXPECT_LT(test::worst_error(found.bends.at(0)), 0.02);
}

TEST_F(FitBendingTraps, AMomentAgainstTheCurvatureIsAskedAbout) {
  Points points = table(1.0, 0.0, random);
  for (double& y : points.y) y = -y;
  write("a.csv", points);
  EXPECT_NE(complaint(table_fit("'a.csv'")).find("say moment_factor = -1"), std::string::npos);
  EXPECT_EQ(complaint(table_fit("'a.csv'", "moment_factor = -1\n")), "");
}

TEST_F(FitBendingTraps, WholeMomentsNeedAWidth) {
  Points points = table(50.0, 0.0, random);
  write("a.csv", points);
  const std::string whole = test::head_of_fit +
                            "[[moment_curvature]]\nname = 'bend'\nfiles = ['a.csv']\ncurvature_column = 'x'\n"
                            "curvature_unit = '1/mm'\nmoment_column = 'y'\nmoment_unit = 'N mm'\n";
  EXPECT_NE(complaint(whole).find("no 'specimen_width' (mm)"), std::string::npos);
  EXPECT_LT(test::worst_error(folder.identify(whole + "specimen_width = 50\n").bends.at(0)), 0.01);
}

TEST_F(FitBendingTraps, WhatIsTypedAndMeasuredIsComplainedOf) {
  write("a.csv", table(1.0, 0.0, random));
  EXPECT_NE(complaint(table_fit("'a.csv'") + "[bending]\nrigidity = 2\n").find("given beside tests"),
            std::string::npos);
}

}  // namespace
}  // namespace weaveform
